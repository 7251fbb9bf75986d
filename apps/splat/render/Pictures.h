/// Pictures of a scene with their files and reports.
#pragma once

#include "render/FrameEnergy.h"
#include "render/Layers.h"
#include "render/Renderer.h"
#include "scene/SceneFile.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

/// What pictures are made of, where they go, and what makes them.
struct PictureJob {
  /// For reports: how the scene and its views were asked for.
  std::string ScenePath, AxesChange, CameraFile;
  const SceneFile &Input;
  const RenderOptions &Options;
  const RenderPlan &Plan;
  Launcher &Launch;
  /// \name Files, of which all but the first may be empty: not wanted
  /// @{
  std::string Output, Json, Pairs;
  LayerFiles Layers;
  /// @}
  PictureFormat Format = {};
  std::optional<EnergyRequest> Energy = std::nullopt;
};

/// The facts by which every effect is needed that some view needs.
ViewFacts factsOfAll(const Scene &S, const std::vector<Camera> &Cameras,
                     const RenderOptions &O);

/// Renders one view.
Expected<RenderResult> drawPicture(const PictureJob &J, const Camera &C);
/// Writes what \p J asks for of the picture of \p C.
Expected<Success> writePicture(const PictureJob &J, const Camera &C,
                               const RenderResult &R);

/// What was done for the picture \p Output of \p C, as --json has it.
Expected<nlohmann::ordered_json> reportOf(const PictureJob &J,
                                          const std::string &Output,
                                          const Camera &C,
                                          const RenderResult &R);

/// The picture's file of one of several views: for out.png and view front
/// out.front.png, for a/front out.a_front.png.
std::string pictureFile(const std::string &Output, const Camera &C);

/// Writes the pictures of \p Cameras and one report of all. \p Written is told
/// each picture's file.
Expected<Success>
writePictures(const PictureJob &J, const std::vector<Camera> &Cameras,
              bool Overlap, const SequenceResult &R,
              const std::function<void(const std::string &)> &Written);

} // namespace vorion::splat
