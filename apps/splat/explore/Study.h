/// Measuring machines: each on each view, kept as a file.
#pragma once

#include "explore/Judge.h"
#include "explore/Space.h"
#include "io/Cameras.h"
#include "sweep/Points.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// Views of one size, in a file for the processes that draw.
struct ViewSet {
  std::string Suffix; ///< of a trial's name: empty for whole views
  std::string CameraFile;
  std::vector<Camera> Views;
};

/// What is measured, and where it is kept.
struct StudyPlan {
  std::string ScenePath, Folder;
  DeviceOptions Machine;       ///< the base
  std::string Technology;      ///< a file; empty for the default
  std::optional<double> Volts; ///< of all machines
  /// Options for every `splat render`, reading the scene among them.
  std::vector<std::string> CommonArguments;
  ViewSet Whole, Small;
  Space Parameters;
  unsigned Jobs = 1; ///< measured at the same time
  Origin From;       ///< what all trials are made from
};

/// \p Base with \p Settings, as --set takes them.
DeviceOptions changed(DeviceOptions Base, const std::string &Settings);

/// A machine on a view.
struct Trial {
  Choices Machine;
  const ViewSet *Of;
  const Camera *View;

  /// "base@front", "6f3a91c0@front@small": what the machine is called is a hash
  /// of its settings, so that a space may change around it.
  std::string name(const Space &S) const;
};

/// All of \p Machines on all views of \p Of.
std::vector<Trial> trialsOf(const ViewSet &Of,
                            const std::vector<Choices> &Machines);

/// The measurements that \p P's folder has; \p Log is told of each file that
/// is not used.
KeptPoints keptTrials(const StudyPlan &P,
                      std::function<void(std::string_view)> Log);

/// Those of \p Of that are to be measured.
std::vector<Trial> missing(const StudyPlan &P, KeptPoints &Kept,
                           const std::vector<Trial> &Of);

/// Measures \p Trials and keeps them. A machine that cannot be, by the
/// simulator's words, is a measurement, too; that the base cannot is an Error.
Expected<Success> measure(const StudyPlan &P, KeptPoints &Kept,
                          const std::vector<Trial> &Trials,
                          const std::function<void(std::string_view)> &Log);

/// A machine over all views of a set.
struct Measured {
  Choices Machine;
  std::string Refused; ///< why it cannot be; else empty
  Figures Is;
  /// By view, as they are kept.
  std::vector<nlohmann::ordered_json> Views;
};

/// \p Machine on all views of \p Of, which are measured.
Expected<Measured> measured(const StudyPlan &P, KeptPoints &Kept,
                            const ViewSet &Of, const Choices &Machine);

} // namespace vorion::splat
