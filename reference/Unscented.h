/// Internal to the reference: the unscented transform (Wu et al. 2025, "3DGUT",
/// with alpha 1, beta 2, kappa 0). A Gaussian goes through the camera as seven
/// of its points: the mean, with a weight of 0 for the mean on the picture and
/// 2 for the covariance, and sqrt(3) deviations along each axis either way,
/// with 1/6.
#pragma once

#include "Footprint.h"

#include <array>
#include <optional>

namespace vorion::reference {

template <typename Real> struct SevenPoints {
  /// In the camera's axes: along axis K those of numbers 2 K and 2 K + 1.
  std::array<Vec3<Real>, 6> Points;
  Vec2<Real> At;    ///< the mean's own place, in units of the focal lengths
  Vec2<Real> Shift; ///< from there to the mean on the picture, px
  /// From the mean on the picture to each point's place and, last, to the
  /// mean's own, times the root of its weight, px. Their squares add up to the
  /// covariance.
  std::array<Vec2<Real>, 7> Off;
};

/// The points of a Gaussian at \p Mean, in the camera's axes, whose axes, as
/// long as its deviations, are the columns of \p Axes. Nothing if the camera
/// does not see one of them, or sees it farther from the mean than
/// \c Options::PointSpread allows: then the footprint is no ellipse, and the
/// Jacobian the better approximation (docs/cameras.md).
template <typename Real>
std::optional<SevenPoints<Real>>
sevenPoints(const Vec3<Real> &Mean, const Mat3<Real> &Axes,
            const Camera<Real> &C, const Options &O);

/// dL/d(mean) and dL/d(axes), by columns.
struct BySevenPoints {
  glm::dvec3 Mean;
  glm::dmat3 Axes;
};

/// The way back through \p S, the points of a Gaussian at \p Mean, from
/// dL/d(mean on the picture) and dL/d(covariance), whose xx, xy and yy are
/// those of a symmetric matrix.
BySevenPoints backThroughPoints(const SevenPoints<double> &S,
                                const glm::dvec3 &Mean, const Camera<double> &C,
                                const glm::dvec2 &ByMean2d,
                                const glm::dvec3 &ByCovariance);

} // namespace vorion::reference
