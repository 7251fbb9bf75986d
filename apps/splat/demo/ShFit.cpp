#include "demo/ShFit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace vorion::splat::demo {

std::array<double, ShTerms> shBasis(const glm::dvec3 &D) {
  const double X = D.x, Y = D.y, Z = D.z;
  const double XX = X * X, YY = Y * Y, ZZ = Z * Z;
  return {0.28209479177387814,
          -0.4886025119029199 * Y,
          0.4886025119029199 * Z,
          -0.4886025119029199 * X,
          1.0925484305920792 * X * Y,
          -1.0925484305920792 * Y * Z,
          0.31539156525252005 * (2 * ZZ - XX - YY),
          -1.0925484305920792 * X * Z,
          0.5462742152960396 * (XX - YY),
          -0.5900435899266435 * Y * (3 * XX - YY),
          2.890611442640554 * X * Y * Z,
          -0.4570457994644658 * Y * (4 * ZZ - XX - YY),
          0.3731763325901154 * Z * (2 * ZZ - 3 * XX - 3 * YY),
          -0.4570457994644658 * X * (4 * ZZ - XX - YY),
          1.445305721320277 * Z * (XX - YY),
          -0.5900435899266435 * X * (XX - 3 * YY)};
}

namespace {

using Terms = std::array<double, ShTerms>;

struct Sample {
  glm::vec3 Direction;
  Terms Basis;
};

/// Evenly spread directions (a spherical Fibonacci lattice).
const std::vector<Sample> &samples() {
  static const std::vector<Sample> All = [] {
    constexpr int Count = 144;
    std::vector<Sample> S;
    for (int I = 0; I < Count; ++I) {
      const double Z = 1 - (2 * I + 1.0) / Count;
      const double R = std::sqrt(1 - Z * Z);
      const double Angle = I * std::numbers::pi * (3 - std::sqrt(5.0));
      const glm::dvec3 D(R * std::cos(Angle), R * std::sin(Angle), Z);
      S.push_back({glm::vec3(D), shBasis(D)});
    }
    return S;
  }();
  return All;
}

/// Solves the symmetric positive definite A x = B, all channels at once.
void solve(std::array<Terms, ShTerms> &A, std::array<glm::dvec3, ShTerms> &B) {
  for (std::size_t K = 0; K < ShTerms; ++K) { // Cholesky, in the lower half
    for (std::size_t J = 0; J < K; ++J) {
      for (std::size_t M = 0; M < J; ++M)
        A[K][J] -= A[K][M] * A[J][M];
      A[K][J] /= A[J][J];
      A[K][K] -= A[K][J] * A[K][J];
    }
    A[K][K] = std::sqrt(A[K][K]);
  }
  for (std::size_t K = 0; K < ShTerms; ++K) {
    for (std::size_t J = 0; J < K; ++J)
      B[K] -= A[K][J] * B[J];
    B[K] /= A[K][K];
  }
  for (std::size_t K = ShTerms; K-- > 0;) {
    for (std::size_t J = K + 1; J < ShTerms; ++J)
      B[K] -= A[J][K] * B[J];
    B[K] /= A[K][K];
  }
}

} // namespace

ShColor fitColor(const glm::vec3 &Normal,
                 const std::function<glm::vec3(const glm::vec3 &)> &Color) {
  std::array<Terms, ShTerms> A{};
  std::array<glm::dvec3, ShTerms> B{};
  for (const Sample &S : samples()) {
    const double Facing = -glm::dot(S.Direction, Normal);
    if (Facing < -0.15)
      continue; // sees the back, which never shows
    const double Weight = std::clamp((Facing + 0.15) / 0.35, 0.0, 1.0);
    const glm::dvec3 Target = glm::dvec3(Color(S.Direction)) - 0.5;
    for (std::size_t K = 0; K < ShTerms; ++K) {
      B[K] += Weight * S.Basis[K] * Target;
      for (std::size_t J = 0; J <= K; ++J)
        A[K][J] += Weight * S.Basis[K] * S.Basis[J];
    }
  }
  for (int Band = 0, K = 0; Band <= 3; ++Band)
    for (int M = 0; M <= 2 * Band; ++M, ++K)
      A[static_cast<std::size_t>(K)][static_cast<std::size_t>(K)] +=
          1e-3 + 0.04 * Band * Band;
  solve(A, B);
  ShColor Result;
  std::ranges::transform(B, Result.begin(),
                         [](const glm::dvec3 &V) { return glm::vec3(V); });
  return Result;
}

ShColor constantColor(const glm::vec3 &Color) {
  ShColor Result{};
  Result[0] = (Color - 0.5F) / 0.28209479F;
  return Result;
}

} // namespace vorion::splat::demo
