/// Measuring machines: each at each task, kept as a file.
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

/// What is measured, and where it is kept.
struct ExplorePlan {
  Workload Does;
  std::string Folder;
  RunSetup Setup;
  Space Parameters;
  /// By kind of work, in the order of AllWork: the options that say how it is
  /// computed. Another option of a space does not change that work.
  std::array<std::set<std::string>, AllWork.size()> Options;
  Provenance From; ///< what all trials are made from
};

/// A machine at a task.
struct Trial {
  Choices Machine; ///< as the task sees it: Space.h, seenBy()
  const Task *What;

  /// "base@front", "6f3a91c0@front@small": what the machine is called is a hash
  /// of its settings, so that a space may change around it.
  std::string name(const Space &S) const;
};

/// All of \p Machines at each of \p Of. Machines that a task cannot tell
/// apart have one trial.
std::vector<Trial> trialsOf(const ExplorePlan &P, const std::vector<Task> &Of,
                            const std::vector<Choices> &Machines);

/// \p Trials as points of a study. They read \p P while they are measured. A
/// machine that cannot be, by the simulator's words, is a measurement, too;
/// that the base cannot is an Error.
std::vector<StudyPoint> studyPoints(const ExplorePlan &P,
                                    const std::vector<Trial> &Trials);

/// The measurements that \p P's folder has; \p Log is told of each file that
/// is not used.
PointStore storeOf(const ExplorePlan &P,
                   std::function<void(std::string_view)> Log);

/// A part of a workload on a machine.
struct MeasuredPart {
  Speed Is;
  /// Of the time and the energy of all parts of its kind of work.
  double TimeShare = 0, EnergyShare = 0;
};

/// A machine over all tasks of a size.
struct Measured {
  Choices Machine;
  std::string Refused; ///< why it cannot be; else empty
  Figures Is;
  std::vector<MeasuredPart> Parts;
  /// By task, as they are kept.
  std::vector<nlohmann::ordered_json> Tasks;
};

/// \p Machine at all of \p Of, which are measured. Of each kind of work,
/// the rate is the sum of the weights over the sum of the weighted times, and
/// the energy is the weighted mean.
Expected<Measured> measured(const ExplorePlan &P, PointStore &Kept,
                            const std::vector<Task> &Of,
                            const Choices &Machine);

} // namespace vorion::splat
