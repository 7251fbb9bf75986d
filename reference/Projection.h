/// Projection of a Gaussian from world space to an ellipse on the picture.
#pragma once

#include "Types.h"

#include <vector>

namespace vorion::reference {

/// A projected Gaussian.
template <typename Real> struct Splat {
  bool Visible = false;   ///< false: culled, and nothing below is meaningful
  bool ByPoints = false;  ///< whether seven points gave the footprint
  glm::vec<2, Real> Mean; ///< pixels
  Real Depth = 0;         ///< camera z
  /// Error bound of z before rounding to fp32, on a device that computes it as
  /// an unevaluated sum of two floats: 2^-44 of the magnitudes of its terms.
  double DepthSlack = 0;
  glm::vec<3, Real> Covariance; ///< xx, xy, yy, dilated, px^2
  /// The added dilation. With a rolling shutter it is isotropic for the static
  /// camera at the mean's exposure time (Shutter.h).
  glm::vec<3, Real> Added;
  glm::vec<3, Real> Conic; ///< its inverse: xx, xy, yy
  Real Compensation = 1;   ///< the antialiasing factor
  Real Opacity = 0;        ///< after compensation
  glm::vec<3, Real> Color;
  /// Half width and height of the box outside which the Gaussian is not
  /// evaluated, by the support. For Official16 the square, before tiles.
  glm::vec<2, Real> Extent;
  /// 3 sqrt(lambda) for the larger eigenvalue, as in INRIA's rules; the
  /// square's half side is this rounded up.
  Real CircleRadius = 0;
  /// The radius along x and y of the rule set, px: for INRIA that of the
  /// square, for gsplat that of its tile test.
  glm::ivec2 Radius{0, 0};
};

/// Projects Gaussian \p I. In fp32 the device must give the same Mean, Depth
/// and Extent bit for bit, so the order of operations is part of the contract:
/// sums and products associate from the left, nothing is contracted, and
///
///     d       = (m - c) - c', c + c' being the camera's centre
///     p       = R d, each row (r0 d0 + r1 d1) + r2 d2: R m + t would lose what
///               the distance from the origin takes (in fp64 p is R m + t)
///     p.z     = as if exact, then rounded once: it decides the order, and
///               rounding must not turn Gaussians round whose depths differ
///     mean    = f p.xy / p.z + c
///     A       = R (Q diag(s)), B = J A with J's two rows
///               (f/z, 0, -f tx/(z z)) and (0, f/z, -f ty/(z z))
///     S       = B B^T, each entry (b0 b0' + b1 b1') + b2 b2'
///     minors  = b0 c1 - b1 c0, b0 c2 - b2 c0, b1 c2 - b2 c1 for B's rows b, c
///     det0    = (minor^2 + minor^2) + minor^2
///     det     = (det0 + h (S_xx + S_yy)) + h h for the dilation h; S_xx and
///               S_yy then become S_xx + h and S_yy + h (behind a rolling
///               shutter h is a matrix)
///     lambda  = mid + sqrt(max(0.1, half^2 + S_xy^2)), mid and half being half
///               the sum and the difference of S_xx and S_yy
///
/// The determinant is a sum of squares (Cauchy-Binet) since S_xx S_yy - S_xy^2
/// loses all digits to cancellation in fp32 for long needles.
///
/// Of a camera with a lens the mean and J are those of Lens.h, and the bits are
/// not promised. A fisheye's and an equirectangular depth is |m - c - c'|.
/// With a rolling shutter they are those of Shutter.h; the depth is the pose's,
/// but the near plane that of the camera when it exposes the mean.
template <typename Real>
Splat<Real> project(const Gaussians<Real> &G, std::size_t I,
                    const Camera<Real> &C, const Options &O);

/// Projects all of \p G. An equirectangular picture goes on behind its right
/// side with its left one: each Gaussian stands there three times, N behind the
/// other, as it is, one picture's width to the right, and one to the left.
template <typename Real>
std::vector<Splat<Real>> project(const Gaussians<Real> &G,
                                 const Camera<Real> &C, const Options &O);

/// Minimum alpha that is blended, for \c Options::AlphaCutoff \p Cutoff.
template <typename Real> constexpr Real leastAlpha(int Cutoff) {
  return Real(Cutoff) / Real(255);
}
/// Lower bound of the ratio of the determinants before and after dilation,
/// whose square root is the antialiasing factor. It keeps very small Gaussians,
/// whose covariance is nearly all dilation, from vanishing.
inline constexpr double LeastDeterminantRatio = 2.5e-5;
/// Maximum alpha: keeps 1 / (1 - alpha) finite in training.
template <typename Real> constexpr Real mostAlpha() { return Real(0.99); }

} // namespace vorion::reference
