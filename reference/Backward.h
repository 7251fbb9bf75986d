/// Gradients of a loss of the picture, back through blending and projection.
#pragma once

#include "Projection.h"

#include <vector>

namespace vorion::reference {

/// A loss as its gradient: dL/d(picture with background) and dL/d(alpha) of
/// every pixel, rows from the top.
struct Upstream {
  std::vector<glm::dvec3> Render;
  std::vector<double> Alpha;
};

/// What blending gives back of one Gaussian, summed over pixels: what the
/// rasterizer hands to a core (docs/rasterizer.md). With dx, dy from the mean
/// to the pixel's centre and s = o G dL/dalpha, where o G is alpha before its
/// clamp.
struct SplatSums {
  glm::dvec3 Color{0}; ///< dL/dcolour: sum of alpha T dL/dpixel
  double S = 0;
  glm::dvec2 Sd{0};  ///< s dx, s dy
  glm::dvec3 Sdd{0}; ///< s dx dx, s dx dy, s dy dy

  SplatSums &operator+=(const SplatSums &Other);
};

/// Goes back through \c blend for splats of which \c project made \p Splats
/// with the same \p O: the sums of each, in the order of \p Splats. Where alpha
/// is held at its clamp the gradient passes under INRIA's rules and is 0 under
/// gsplat's. The result does not depend on the number of threads.
std::vector<SplatSums> blendBackward(const std::vector<Splat<double>> &Splats,
                                     int Width, int Height, const Upstream &U,
                                     const Options &O);

/// dL/d(parameters) of a \c Gaussians, and of what lies between.
struct Gradients {
  std::vector<SplatSums> Sums;
  std::vector<glm::dvec2> Means2d; ///< px
  std::vector<glm::dvec3> Conics;  ///< xx, xy (once), yy
  std::vector<glm::dvec3> Means, Scales;
  /// Of quaternions that are normalised first, at unit length: orthogonal to
  /// the quaternion. For one of length n the gradient is an n-th of it.
  std::vector<glm::dvec4> Quats;
  std::vector<double> Opacities;
  std::vector<glm::dvec3> Colors; ///< as blended
  std::vector<glm::dvec3> Sh;     ///< empty where the colours are direct
};

/// \c blendBackward and the way back through \c project. INRIA's rules take a
/// coordinate that the Jacobian holds at its limit for a constant; gsplat's
/// differentiate the limit. Gaussians that are not seen have gradients 0.
Gradients renderBackward(const Gaussians<double> &G, const Camera<double> &C,
                         const Upstream &U, const Options &O);

} // namespace vorion::reference
