/// Pictures of a scene with their files and reports.
#pragma once

#include "render/FrameEnergy.h"
#include "render/Layers.h"
#include "render/Renderer.h"
#include "render/WhatIf.h"
#include "scene/SceneFile.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

/// Inputs, outputs and renderer of pictures.
struct PictureJob {
  /// For reports: the scene and its views on the command line.
  std::string ScenePath, AxesChange, CameraFile;
  SceneFile &Input; ///< its Gaussians are given to the device
  std::size_t Gaussians;
  const RenderOptions &Options;
  const RenderPlan &Plan;
  Launcher &Launch;
  /// \name Output files; all but the first may be empty (not requested)
  /// @{
  std::string Output, Json, Pairs;
  LayerFiles Layers;
  /// @}
  PictureFormat Format = {};
  std::optional<EnergyRequest> Energy = std::nullopt;
  std::vector<WhatIf> Others; ///< the same picture on other machines
};

/// The combined properties of all views: an effect is needed if one view needs
/// it.
ViewFacts factsOfAll(const Scene &S, const std::vector<Camera> &Cameras,
                     const RenderOptions &O);

/// Renders one view.
Expected<RenderResult> drawPicture(const PictureJob &J, const Camera &C);
/// Writes the outputs of \p J for the picture of \p C.
Expected<Success> writePicture(const PictureJob &J, const Camera &C,
                               const RenderResult &R);

/// The report of the picture \p Output of \p C, for --json.
Expected<nlohmann::ordered_json> reportOf(const PictureJob &J,
                                          const std::string &Output,
                                          const Camera &C,
                                          const RenderResult &R);

/// The file name of a picture of several: out.front.png for out.png and view
/// front, out.a_front.png for view a/front.
std::string pictureFile(const std::string &Output, const Camera &C);

/// Writes the pictures of \p Cameras and one report. \p Written is called with
/// the file name of each picture.
Expected<Success>
writePictures(const PictureJob &J, const std::vector<Camera> &Cameras,
              bool Overlap, const SequenceResult &R,
              const std::function<void(const std::string &)> &Written);

} // namespace vorion::splat
