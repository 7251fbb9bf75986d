/// One forward and one backward pass of a view, and their results.
#pragma once

#include "io/Cameras.h"
#include "io/Image.h"
#include "render/Backward.h"
#include "render/Renderer.h"
#include "scene/Scene.h"

#include <vector>

namespace vorion::splat {

/// dL/d(picture with background), 3 per pixel, and dL/d(alpha), 1 per pixel,
/// rows from the top.
struct PixelGradients {
  std::vector<float> Render, Alpha;
};

/// dL/d(parameters), in the order of the scene, by activated scales and
/// opacities and by stored quaternions.
struct SceneGradients {
  std::vector<float> Means, Scales, Quats, Opacities; ///< 3, 3, 4, 1 each
  std::vector<float> Sh;      ///< [coefficient][channel] each
  std::vector<float> Means2d; ///< 2 each, px
  std::vector<float> Conics;  ///< 3 each: xx, xy (once), yy
  /// The sums that the rasterizer passes to the cores (docs/abi.md,
  /// "Backward"): recordSums() planes.
  std::vector<float> Sums;
};

/// The picture, the stages of both passes, and the gradients.
struct GradientResult : RenderResult {
  SceneGradients Gradients;
};

/// The plan of \c takeGradients.
RenderPlan gradientPlan(const Scene &S, const Camera &C,
                        const RenderOptions &Options);

/// Renders the view \p C of \p S and propagates \p U to the parameters. \p
/// Options must have Training set. A mesh of theirs must be opaque.
Expected<GradientResult> takeGradients(Launcher &L, const Scene &S,
                                       const Camera &C,
                                       const RenderOptions &Options,
                                       const BackwardOptions &Backward,
                                       const PixelGradients &U);

} // namespace vorion::splat
