/// A 3D Gaussian scene as stored by trainers: parameters before activation.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <string>
#include <vector>

namespace vorion::splat {

/// Largest degree of spherical harmonics that a scene may have.
inline constexpr int MaxShDegree = 3;

/// Coefficients of each colour channel for degree \p ShDegree.
constexpr std::size_t shCoefficients(int ShDegree) {
  return static_cast<std::size_t>(ShDegree + 1) * (ShDegree + 1);
}

/// The degree with \p Later coefficients per channel above degree 0; -1 if
/// there is none.
constexpr int shDegreeOf(std::size_t Later) {
  for (int Degree = 0; Degree <= MaxShDegree; ++Degree)
    if (shCoefficients(Degree) - 1 == Later)
      return Degree;
  return -1;
}

/// Y_00, the factor of the coefficient of degree 0.
inline constexpr double ShC0 = 0.28209479177387814;

/// \c size() Gaussians, one array per parameter. World units are those of the
/// file, without conversion.
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

  /// \p Count zero-initialized Gaussians. A reader must first check that its
  /// file is large enough for this number.
  static Scene sized(std::size_t Count, int ShDegree);
};

/// Error: a Gaussian has a NaN or an infinity, for which the comparisons of
/// renderers are undefined.
Expected<Success> checkFinite(const std::string &Where, const Scene &S);

/// Drops the Gaussians with a NaN or an infinity, preserves the order of the
/// others, and returns the number of dropped ones.
std::size_t dropNonFinite(Scene &S);

/// Copies \p Count Gaussians of \p From, starting at \p First, over those of
/// \p To that start at \p At; both of the same degree.
void copy(const Scene &From, std::size_t First, std::size_t Count, Scene &To,
          std::size_t At);

/// Appends \p Count Gaussians of \p From, starting at \p First, to \p To; both
/// of the same degree.
void append(Scene &To, const Scene &From, std::size_t First, std::size_t Count);

} // namespace vorion::splat
