/// Measuring settings: each on each view, kept as a file.
#pragma once

#include "accuracy/Front.h"
#include "sweep/Points.h"

#include "device/DeviceOptions.h"
#include "io/Cameras.h"
#include "scene/SceneFile.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>

namespace vorion::splat {

/// What a sweep measures, and where it keeps it.
struct SweepPlan {
  std::string ScenePath, CameraFile, Folder;
  DeviceOptions Machine;
  /// Options for every `splat render`, reading the scene among them.
  std::vector<std::string> CommonArguments;
  std::vector<Camera> Views;
  std::vector<Knob> Knobs;
  bool Cores = true; ///< the kernels-only path too
  /// The chip's joules are a cost, and the machine must have them; else they
  /// are only measured where it has.
  bool Energy = false;
  unsigned Jobs = 1;         ///< measured at the same time
  unsigned ThumbWidth = 240; ///< of the page's pictures, px
  Origin From;               ///< what all points are made from
  std::function<Expected<SceneFile>()> Load;
};

/// A setting on a view.
struct Point {
  Setting Chosen;
  const Camera *View;

  /// "exp=poly3@front".
  std::string name() const;
};

/// All of \p Settings on all views of \p P.
std::vector<Point> pointsOf(const SweepPlan &P,
                            const std::vector<Setting> &Settings);

/// The point with this name.
Expected<Point> pointNamed(const SweepPlan &P, const std::string &Name);

/// What the measurement of a point is made from.
Origin originOf(const SweepPlan &P, const Point &Of);

/// The measurements that \p P's folder has; \p Log is told of each file that
/// is not used.
KeptPoints keptPoints(const SweepPlan &P,
                      std::function<void(std::string_view)> Log);

/// Those of \p Of that are to be measured.
std::vector<Point> missing(const SweepPlan &P, KeptPoints &Kept,
                           const std::vector<Point> &Of);

/// Measures \p Points and keeps them; \p Log gets a line for each one that is
/// done.
Expected<Success> measure(const SweepPlan &P, KeptPoints &Kept,
                          const std::vector<Point> &Points,
                          const std::function<void(std::string_view)> &Log);

/// The measurement of a point that is there; an Error of one that is not.
Expected<nlohmann::ordered_json> readPoint(const SweepPlan &P, KeptPoints &Kept,
                                           const Point &Of);

/// \p Settings over \p Views, all of which are measured.
Expected<std::vector<Candidate>>
candidates(const SweepPlan &P, KeptPoints &Kept,
           const std::vector<Setting> &Settings,
           const std::vector<const Camera *> &Views);

} // namespace vorion::splat
