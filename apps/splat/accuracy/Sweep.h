/// Measuring settings: each on each view, kept as a file.
#pragma once

#include "accuracy/Front.h"
#include "study/Study.h"

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
  unsigned ThumbWidth = 240; ///< of the page's pictures, px
  Provenance From;           ///< what all points are made from
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
Provenance provenanceOf(const SweepPlan &P, const Point &Of);

/// \p Points as points of a study. They read \p P while they are measured.
std::vector<StudyPoint>
studyPoints(const SweepPlan &P, const std::vector<Point> &Points,
            const std::function<void(std::string_view)> &Log);

/// The measurements that \p P's folder has; \p Log is told of each file that
/// is not used.
PointStore storeOf(const SweepPlan &P,
                   std::function<void(std::string_view)> Log);

/// Of `splat render`: a view of \p P's scene into the file \p Output.
std::vector<std::string> renderWords(const SweepPlan &P,
                                     const std::string &View,
                                     const std::string &Output);

/// The measurement of a point that is there; an Error of one that is not.
Expected<nlohmann::ordered_json> readPoint(const SweepPlan &P, PointStore &Kept,
                                           const Point &Of);

/// \p Settings over \p Views, all of which are measured.
Expected<std::vector<Candidate>>
candidates(const SweepPlan &P, PointStore &Kept,
           const std::vector<Setting> &Settings,
           const std::vector<const Camera *> &Views);

} // namespace vorion::splat
