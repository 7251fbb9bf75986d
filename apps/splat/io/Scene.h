/// A 3D Gaussian scene as the trainers store it: parameters before activation.
#pragma once

#include <cstddef>
#include <vector>

namespace vorion::splat {

/// Largest degree of spherical harmonics that a scene may have.
inline constexpr int MaxShDegree = 3;

/// Coefficients of each colour channel for degree \p ShDegree.
constexpr std::size_t shCoefficients(int ShDegree) {
  return static_cast<std::size_t>(ShDegree + 1) * (ShDegree + 1);
}

/// \c size() Gaussians, one array a parameter. World units are those of the
/// file; nothing is flipped or scaled on reading.
struct Scene {
  int ShDegree = 0;                 ///< 0 to MaxShDegree
  std::vector<float> Means;         ///< 3 each: x, y, z
  std::vector<float> LogScales;     ///< 3 each: natural logarithm
  std::vector<float> Quats;         ///< 4 each: w, x, y, z, any norm
  std::vector<float> OpacityLogits; ///< 1 each: opacity = 1 / (1 + e^-logit)
  std::vector<float> Sh;            ///< [coefficient][channel] each

  std::size_t size() const { return OpacityLogits.size(); }
  /// Coefficients of each channel.
  std::size_t coefficients() const { return shCoefficients(ShDegree); }
};

} // namespace vorion::splat
