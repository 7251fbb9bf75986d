/// Backward pass: gradients of a loss of the picture through blending and
/// projection.
#pragma once

#include "Projection.h"
#include "Render.h"

#include <vector>

namespace vorion::reference {

/// A loss as its gradient: dL/d(picture with background) and dL/d(alpha) of
/// every pixel, rows from the top.
struct Upstream {
  std::vector<glm::dvec3> Render;
  std::vector<double> Alpha;
};

/// Partial gradients of one Gaussian from blending, summed over pixels: the
/// sums that the rasterizer passes to a core (docs/rasterizer.md). dx, dy is
/// the offset from the mean to the pixel's centre, and s = o G dL/dalpha, where
/// o G is alpha before clamping.
struct SplatSums {
  glm::dvec3 Color{0}; ///< dL/dcolour: sum of alpha T dL/dpixel
  double S = 0;
  glm::dvec2 Sd{0};  ///< s dx, s dy
  glm::dvec3 Sdd{0}; ///< s dx dx, s dx dy, s dy dy

  SplatSums &operator+=(const SplatSums &Other);
};

/// Backward pass of \c blend, for \p Splats of \c project with the same \p O:
/// the sums of each, in the order of \p Splats. Where alpha is clamped, the
/// gradient is passed through with INRIA's rules and is 0 with gsplat's. The
/// result does not depend on the number of threads. \p Behind: as of \c blend,
/// without layers; alpha is 1 where it is.
std::vector<SplatSums> blendBackward(const std::vector<Splat<double>> &Splats,
                                     int Width, int Height, const Upstream &U,
                                     const Options &O,
                                     const Surface<double> *Behind = nullptr);

/// dL/d(parameters) of a \c Gaussians, and intermediate gradients.
struct Gradients {
  std::vector<SplatSums> Sums;
  std::vector<glm::dvec2> Means2d; ///< px
  std::vector<glm::dvec3> Conics;  ///< xx, xy (once), yy
  std::vector<glm::dvec3> Means, Scales;
  /// With respect to normalized quaternions: orthogonal to the quaternion. For
  /// a quaternion of length n the gradient is this divided by n.
  std::vector<glm::dvec4> Quats;
  std::vector<double> Opacities;
  std::vector<glm::dvec3> Colors; ///< as blended
  std::vector<glm::dvec3> Sh;     ///< empty where the colours are direct
};

/// Backward pass of \c blend and \c project. INRIA's rules treat a coordinate
/// that is clamped in the Jacobian as a constant; gsplat's differentiate the
/// limit. Gradients of culled Gaussians are 0.
Gradients renderBackward(const Gaussians<double> &G, const Camera<double> &C,
                         const Upstream &U, const Options &O,
                         const Surface<double> *Behind = nullptr);

} // namespace vorion::reference
