/// How a study goes: its points are measured, several at a time, and kept, and
/// what they say is written. Commands say which points they are.
#pragma once

#include "study/PointStore.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// A point of a study: a measurement that is kept under its name.
struct StudyPoint {
  std::string Name;
  Provenance From;
  /// Makes what Measure reads, unless it is there, before any point is
  /// measured. What it holds is freed then.
  std::function<Expected<Success>()> Prepare = [] { return Success{}; };
  std::function<Expected<nlohmann::ordered_json>()> Measure;
  /// A measurement in a line.
  std::function<std::string(const nlohmann::ordered_json &)> Describe;
};

/// What a command line says about every study.
struct StudyOptions {
  std::string Folder; ///< of measurements and page
  unsigned Jobs = 1;  ///< points that are measured at the same time
  bool List = false;  ///< measure none, and print the names of those missing
  std::vector<std::string> Only; ///< names, as List prints them
};

/// Those of \p Of that \p Kept lacks.
std::vector<StudyPoint> missing(PointStore &Kept, std::vector<StudyPoint> Of);

/// Measures all of \p Wanted, \p Jobs at a time, and keeps them; \p Log gets a
/// line for each one that is done, with an estimate of the time left. Ends with
/// the first that fails.
Expected<Success> measureAll(PointStore &Kept, std::vector<StudyPoint> Wanted,
                             unsigned Jobs,
                             const std::function<void(std::string_view)> &Log);

/// The points of \p Known that \p Only names; an Error of usage, with what was
/// \p Wanted, says which is no such \p What.
Expected<std::vector<StudyPoint>>
pointsNamed(const std::vector<StudyPoint> &Known,
            const std::vector<std::string> &Only, std::string_view What,
            std::string_view Wanted);

/// What differs between studies.
struct StudySteps {
  /// The points of the present round, measured or not. What is measured so far
  /// may say which they are. A study is done when none is missing.
  std::function<Expected<std::vector<StudyPoint>>()> Round;
  /// The points that these names are of.
  std::function<Expected<std::vector<StudyPoint>>(
      const std::vector<std::string> &)>
      Named;
  /// Writes the files that all points read.
  std::function<Expected<Success>()> Begin = [] { return Success{}; };
  /// Writes and prints what the points say.
  std::function<Expected<Success>()> End;
};

/// Goes through a study as \p O says.
Expected<Success> runStudy(const StudyOptions &O, PointStore &Kept,
                           const StudySteps &Steps,
                           const std::function<void(std::string_view)> &Log);

} // namespace vorion::splat
