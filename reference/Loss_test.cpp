#include "Loss.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace vorion::reference;

namespace {

std::vector<glm::dvec3> noise(std::size_t Count, unsigned Seed) {
  std::mt19937 Random(Seed);
  std::uniform_real_distribution<double> Unit(0, 1);
  std::vector<glm::dvec3> Out;
  for (std::size_t I = 0; I < Count; ++I)
    Out.emplace_back(Unit(Random), Unit(Random), Unit(Random));
  return Out;
}

TEST(Loss, EqualPicturesHaveNone) {
  const auto X = noise(std::size_t{20} * 17, 1);
  const Loss L = lossOf(X, X, 20, 17);
  EXPECT_EQ(L.Absolute, 0);
  EXPECT_NEAR(L.Ssim, 1, 1e-14);
  EXPECT_NEAR(L.Value, 0, 1e-14);
  // They are where SSIM is largest.
  for (const glm::dvec3 &G : L.Gradient)
    EXPECT_NEAR(std::abs(G.r) + std::abs(G.g) + std::abs(G.b), 0, 1e-14);
}

/// In the middle, away from the border, SSIM of two constants is known.
TEST(Loss, ConstantPicturesHaveTheirClosedForm) {
  constexpr int Side = 31;
  const std::vector<glm::dvec3> X(Side * Side, glm::dvec3(0.25)),
      Y(Side * Side, glm::dvec3(0.75));
  LossRule Small;
  Small.Reach = 0; // a window of one pixel: no variance, no border
  const Loss L = lossOf(X, Y, Side, Side, Small);
  EXPECT_NEAR(L.Absolute, 0.5, 1e-12);
  EXPECT_NEAR(L.Ssim, (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4),
              1e-12);
  EXPECT_NEAR(L.Value, 0.8 * 0.5 + 0.2 * (1 - L.Ssim), 1e-12);
}

TEST(Loss, GradientIsThatOfFiniteDifferences) {
  constexpr int Width = 9, Height = 13;
  auto X = noise(Width * Height, 2);
  const auto Y = noise(Width * Height, 3);
  const Loss L = lossOf(X, Y, Width, Height);
  constexpr double Step = 1e-5;
  for (const std::size_t I : {0U, 4U, 40U, 77U, 116U})
    for (int C = 0; C < 3; ++C) {
      const double At = X[I][C];
      X[I][C] = At + Step;
      const double Above = lossOf(X, Y, Width, Height).Value;
      X[I][C] = At - Step;
      const double Below = lossOf(X, Y, Width, Height).Value;
      X[I][C] = At;
      EXPECT_NEAR(L.Gradient[I][C], (Above - Below) / (2 * Step), 1e-9);
    }
}

} // namespace
