/// One forward and one backward pass of a view, with everything that comes out.
#pragma once

#include "io/Cameras.h"
#include "io/Image.h"
#include "render/Backward.h"
#include "render/Renderer.h"
#include "scene/Scene.h"

#include <vector>

namespace vorion::splat {

/// dL/d(picture with background), 3 a pixel, and dL/d(alpha), 1 a pixel, rows
/// from the top.
struct PixelGradients {
  std::vector<float> Render, Alpha;
};

/// dL/d(parameters), in the order of the scene; of activated scales and
/// opacities, and of quaternions as they are stored.
struct SceneGradients {
  std::vector<float> Means, Scales, Quats, Opacities; ///< 3, 3, 4, 1 each
  std::vector<float> Sh;      ///< [coefficient][channel] each
  std::vector<float> Means2d; ///< 2 each, px
  std::vector<float> Conics;  ///< 3 each: xx, xy (once), yy
  /// What the rasterizer hands over (docs/abi.md, "Backward"): SUM_WORDS
  /// planes.
  std::vector<float> Sums;
};

/// The picture, the stages of both passes, and what came back.
struct GradientResult : RenderResult {
  SceneGradients Gradients;
};

/// The plan by which \c takeGradients renders.
RenderPlan gradientPlan(const Scene &S, const Camera &C,
                        const RenderOptions &Options);

/// Renders \p S as \p C sees it and takes \p U back. \p Options has Training
/// set.
Expected<GradientResult> takeGradients(Launcher &L, const Scene &S,
                                       const Camera &C,
                                       const RenderOptions &Options,
                                       const BackwardOptions &Backward,
                                       const PixelGradients &U);

} // namespace vorion::splat
