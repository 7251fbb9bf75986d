/// Comparing a decoded scene with what was encoded, within bounds that follow
/// from the format.
#pragma once

#include "scene/Activation.h"
#include "scene/Scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>

namespace vorion::splat::testing {

/// Largest differences of two scenes of the same Gaussians in the same order.
/// Opacities are compared activated; rotations as unit quaternions, whose sign
/// is free.
struct Differences {
  double Mean = 0, LogScale = 0, Quat = 0, Opacity = 0, Color = 0, Later = 0;
};

inline Differences differencesOf(const Scene &A, const Scene &B) {
  Differences D;
  EXPECT_EQ(A.size(), B.size());
  EXPECT_EQ(A.ShDegree, B.ShDegree);
  if (A.size() != B.size() || A.ShDegree != B.ShDegree)
    return D;
  const auto Largest = [](const std::vector<float> &X,
                          const std::vector<float> &Y) {
    double Most = 0;
    for (std::size_t I = 0; I < X.size(); ++I)
      Most = std::max(Most, std::abs(double(X[I]) - Y[I]));
    return Most;
  };
  D.Mean = Largest(A.Means, B.Means);
  D.LogScale = Largest(A.LogScales, B.LogScales);
  const auto X = activate<double>(A), Y = activate<double>(B);
  for (std::size_t I = 0; I < A.size(); ++I) {
    D.Opacity = std::max(D.Opacity, std::abs(X.Opacities[I] - Y.Opacities[I]));
    double Dot = 0;
    for (std::size_t K = 0; K < 4; ++K)
      Dot += X.Quats[4 * I + K] * Y.Quats[4 * I + K];
    for (std::size_t K = 4 * I; K < 4 * I + 4; ++K)
      D.Quat = std::max(
          D.Quat, std::abs(X.Quats[K] - (Dot < 0 ? -Y.Quats[K] : Y.Quats[K])));
  }
  const std::size_t Each = 3 * A.coefficients();
  for (std::size_t I = 0; I < A.Sh.size(); ++I) {
    double &To = I % Each < 3 ? D.Color : D.Later;
    To = std::max(To, std::abs(double(A.Sh[I]) - B.Sh[I]));
  }
  return D;
}

} // namespace vorion::splat::testing
