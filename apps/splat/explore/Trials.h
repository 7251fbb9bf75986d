/// Measurement of machines on tasks.
#pragma once

#include "explore/Judge.h"
#include "explore/Measurement.h"
#include "explore/Space.h"
#include "explore/Workload.h"
#include "study/Study.h"

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace vorion::splat {

/// The parameters of a study.
struct ExplorePlan {
  Workload Does;
  std::string Folder;
  RunSetup Setup;
  Space Parameters;
  /// By kind of work, in the order of AllWork: the options that affect it.
  /// Other options of a space do not change that work.
  std::array<std::set<std::string>, AllWork.size()> Options;
  Provenance From; ///< common provenance of all trials
};

/// A task on a machine.
struct Trial {
  Choices Machine; ///< the choices that affect the task: Space.h, seenBy()
  const Task *What;

  /// "base@front", "6f3a91c0@front@small": a machine's name is a hash of its
  /// settings, so that it does not depend on the rest of the space.
  std::string name(const Space &S) const;
};

/// All tasks \p Of on all \p Machines. Machines that are equal for a task share
/// one trial.
std::vector<Trial> trialsOf(const ExplorePlan &P, const std::vector<Task> &Of,
                            const std::vector<Choices> &Machines);

/// \p Trials as points of a study. \p P must outlive their measurement. A
/// machine that the simulator rejects is a measurement, too; if it is the base,
/// it is an Error.
std::vector<StudyPoint> studyPoints(const ExplorePlan &P,
                                    const std::vector<Trial> &Trials);

/// The stored measurements in \p P's folder; \p Log is called for each rejected
/// file.
PointStore storeOf(const ExplorePlan &P,
                   std::function<void(std::string_view)> Log);

/// The results of a part of a workload on a machine.
struct MeasuredPart {
  Speed Is;
  /// Fractions of the time and energy of all parts with its kind of work.
  double TimeShare = 0, EnergyShare = 0;
};

/// The results of a machine over all tasks of a size.
struct Measured {
  Choices Machine;
  std::string Refused; ///< the reason why it is impossible; otherwise empty
  Figures Is;
  std::vector<MeasuredPart> Parts;
  /// Stored measurements by task.
  std::vector<nlohmann::ordered_json> Tasks;
};

/// The results of \p Machine over the tasks \p Of, which must be measured. For
/// each kind of work, the rate is the sum of the weights divided by the sum of
/// the weighted times, and the energy is the weighted mean.
Expected<Measured> measured(const ExplorePlan &P, PointStore &Kept,
                            const std::vector<Task> &Of,
                            const Choices &Machine);

} // namespace vorion::splat
