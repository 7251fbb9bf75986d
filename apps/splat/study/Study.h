/// The study engine: measures the points of a study in parallel, stores the
/// measurements, and writes the results. Each command defines its points.
#pragma once

#include "study/PointStore.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// A point of a study: a measurement that is stored under its name.
struct StudyPoint {
  std::string Name;
  Provenance From;
  /// Creates the inputs of Measure that do not exist yet. It runs before any
  /// point is measured, and is destroyed afterwards with what it captured.
  std::function<Expected<Success>()> Prepare = [] { return Success{}; };
  std::function<Expected<nlohmann::ordered_json>()> Measure;
  /// A one-line summary of a measurement.
  std::function<std::string(const nlohmann::ordered_json &)> Describe;
};

/// The options that all studies have.
struct StudyOptions {
  std::string Folder;            ///< of the measurements and the page
  std::string Figures;           ///< folder of the page's; empty for none
  unsigned Jobs = 1;             ///< number of points measured in parallel
  bool List = false;             ///< only print the names of the missing points
  std::vector<std::string> Only; ///< names of points, as List prints them
};

/// The points of \p Of that are not in \p Kept.
std::vector<StudyPoint> missing(PointStore &Kept, std::vector<StudyPoint> Of);

/// Measures all points of \p Wanted, \p Jobs in parallel, and stores them in \p
/// Kept. \p Log receives a line per finished point, with an estimate of the
/// remaining time. Stops at the first failure.
Expected<Success> measureAll(PointStore &Kept, std::vector<StudyPoint> Wanted,
                             unsigned Jobs,
                             const std::function<void(std::string_view)> &Log);

/// The points of \p Known with the names \p Only. An unknown name is a usage
/// error; its message calls a point \p What, and \p Wanted describes the valid
/// names.
Expected<std::vector<StudyPoint>>
pointsNamed(const std::vector<StudyPoint> &Known,
            const std::vector<std::string> &Only, std::string_view What,
            std::string_view Wanted);

/// The callbacks of a study.
struct StudySteps {
  /// The points of the current round, measured or not. They may depend on
  /// earlier measurements. A study is complete when no point is missing.
  std::function<Expected<std::vector<StudyPoint>>()> Round;
  /// The points with these names.
  std::function<Expected<std::vector<StudyPoint>>(
      const std::vector<std::string> &)>
      Named;
  /// Writes the input files that all points share.
  std::function<Expected<Success>()> Begin = [] { return Success{}; };
  /// Writes and prints the results.
  std::function<Expected<Success>()> End;
};

/// Runs a study with the options \p O.
Expected<Success> runStudy(const StudyOptions &O, PointStore &Kept,
                           const StudySteps &Steps,
                           const std::function<void(std::string_view)> &Log);

} // namespace vorion::splat
