/// A 3D Gaussian scene as stored by trainers: parameters before activation.
#pragma once

#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace vorion::splat {

/// Largest degree of spherical harmonics that a scene may have.
inline constexpr int MaxShDegree = 3;

/// Largest degree of files, whose later coefficients readers leave out.
inline constexpr int MaxStoredShDegree = 4;

/// Coefficients of each colour channel for degree \p ShDegree.
constexpr std::size_t shCoefficients(int ShDegree) {
  return static_cast<std::size_t>(ShDegree + 1) * (ShDegree + 1);
}

/// The degree with \p Later coefficients per channel above degree 0; -1 if
/// there is none.
constexpr int shDegreeOf(std::size_t Later) {
  for (int Degree = 0; Degree <= MaxStoredShDegree; ++Degree)
    if (shCoefficients(Degree) - 1 == Later)
      return Degree;
  return -1;
}

/// Y_00, the factor of the coefficient of degree 0.
inline constexpr double ShC0 = 0.28209479177387814;

/// \c size() Gaussians, one array per parameter. World units are those of the
/// file, without conversion, and so is the frame, unless \c Origin is set.
struct Scene {
  int ShDegree = 0;                 ///< 0 to MaxShDegree
  std::vector<float> Means;         ///< 3 each: x, y, z, from Origin
  std::vector<float> LogScales;     ///< 3 each: natural logarithm
  std::vector<float> Quats;         ///< 4 each: w, x, y, z, any norm
  std::vector<float> OpacityLogits; ///< 1 each: opacity = 1 / (1 + e^-logit)
  std::vector<float> Sh;            ///< [coefficient][channel] each
  /// 3 each, or empty where all are 0: what rounding to fp32 took from Means.
  /// Files of doubles and transforms have it, for transforms that follow.
  std::vector<double> MeanRests;
  /// Where Means begin. Readers and edits leave it at 0; recentre() and
  /// training set it where fp32 does not hold the coordinates (LocalFrame.h).
  std::array<double, 3> Origin{};

  std::size_t size() const { return OpacityLogits.size(); }
  /// Coefficients of each channel.
  std::size_t coefficients() const { return shCoefficients(ShDegree); }
  /// Value \p I of the means, below 3 size(), in the caller's frame before
  /// rounding to fp32.
  double mean(std::size_t I) const {
    return Origin[I % 3] + Means[I] + (MeanRests.empty() ? 0 : MeanRests[I]);
  }
  /// The same as fp32.
  float roundedMean(std::size_t I) const {
    return Origin[I % 3] == 0 ? Means[I] : static_cast<float>(mean(I));
  }
  /// Sets it: its fp32 and the rest.
  void setMean(std::size_t I, double Value);
  /// Measures the means from \p To: the same Gaussians.
  void setOrigin(const std::array<double, 3> &To);

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

/// Keeps the Gaussians whose index satisfies \p Keep, in order; returns the
/// number of dropped ones.
std::size_t keepOnly(Scene &S, const std::function<bool(std::size_t)> &Keep);

/// Copies \p Count Gaussians of \p From, starting at \p First, over those of
/// \p To that start at \p At; both of the same degree and origin.
void copy(const Scene &From, std::size_t First, std::size_t Count, Scene &To,
          std::size_t At);

/// Appends \p Count Gaussians of \p From, starting at \p First, to \p To; both
/// of the same degree and origin.
void append(Scene &To, const Scene &From, std::size_t First, std::size_t Count);

} // namespace vorion::splat
