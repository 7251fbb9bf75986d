/// Measurement of settings on views.
#pragma once

#include "accuracy/Front.h"
#include "study/Study.h"

#include "device/DeviceOptions.h"
#include "io/Cameras.h"
#include "scene/SceneFile.h"

#include <array>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace vorion::splat {

/// The parameters of a sweep.
struct SweepPlan {
  std::string ScenePath, CameraFile, Folder;
  DeviceOptions Machine;
  /// Options of every `splat render`, including those for reading the scene.
  std::vector<std::string> CommonArguments;
  std::vector<Camera> Views;
  /// A mesh that is drawn with the Gaussians, in the world, or null.
  std::shared_ptr<const Mesh> Surface;
  std::optional<std::array<float, 3>> Light; ///< as RenderOptions has it
  std::vector<Knob> Knobs;
  bool Cores = true; ///< also measure the path `simt`
  /// Whether the chip's joules are a cost, which the machine must then support;
  /// otherwise they are measured if supported.
  bool Energy = false;
  unsigned ThumbWidth = 240; ///< width of the page's pictures, px
  Provenance From;           ///< common provenance of all points
  std::function<Expected<SceneFile>()> Load;
};

/// A setting on a view.
struct Point {
  Setting Chosen;
  const Camera *View;

  /// "exp=poly3@front".
  std::string name() const;
};

/// All \p Settings on all views of \p P.
std::vector<Point> pointsOf(const SweepPlan &P,
                            const std::vector<Setting> &Settings);

/// The point with this name.
Expected<Point> pointNamed(const SweepPlan &P, const std::string &Name);

/// The provenance of the measurement of a point.
Provenance provenanceOf(const SweepPlan &P, const Point &Of);

/// \p Points as points of a study. \p P must outlive their measurement.
std::vector<StudyPoint>
studyPoints(const SweepPlan &P, const std::vector<Point> &Points,
            const std::function<void(std::string_view)> &Log);

/// The stored measurements in \p P's folder; \p Log is called for each rejected
/// file.
PointStore storeOf(const SweepPlan &P,
                   std::function<void(std::string_view)> Log);

/// Arguments of `splat render` for a view of \p P's scene, written to \p
/// Output.
std::vector<std::string> renderWords(const SweepPlan &P,
                                     const std::string &View,
                                     const std::string &Output);

/// The stored measurement of a point; an Error if there is none.
Expected<nlohmann::ordered_json> readPoint(const SweepPlan &P, PointStore &Kept,
                                           const Point &Of);

/// The results of \p Settings over \p Views, all of which must be measured.
Expected<std::vector<Candidate>>
candidates(const SweepPlan &P, PointStore &Kept,
           const std::vector<Setting> &Settings,
           const std::vector<const Camera *> &Views);

} // namespace vorion::splat
