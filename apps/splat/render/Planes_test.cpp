#include "render/Planes.h"

#include "picture/Layout.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

using namespace vorion::splat;

namespace {

constexpr std::size_t Count = 3 * LINE_WORDS + 5;
constexpr std::size_t Blocks = 4;

Scene randomScene() {
  std::mt19937 Random(3);
  std::normal_distribution<float> Normal;
  Scene S = Scene::sized(Count, 0);
  for (float &Mean : S.Means)
    Mean = 100 + Normal(Random);
  for (float &Scale : S.LogScales)
    Scale = Normal(Random);
  return S;
}

float bound(const std::vector<float> &Bounds, std::size_t Plane,
            std::size_t Block) {
  return Bounds[Plane * Blocks + Block];
}

TEST(BlockBounds, HoldEveryGaussian) {
  const Scene S = randomScene();
  const std::vector<float> Bounds = blockBounds(S);
  ASSERT_EQ(Bounds.size(), Blocks * BOUND_PLANES);
  for (std::size_t I = 0; I < Count; ++I) {
    const std::size_t B = I / LINE_WORDS;
    double Square = 0;
    for (std::size_t K = 0; K < 3; ++K) {
      Square += std::pow(double{S.Means[3 * I + K]} -
                             double{bound(Bounds, BOUND_CENTER + K, B)},
                         2);
      EXPECT_LE(std::exp(double{S.LogScales[3 * I + K]}),
                bound(Bounds, BOUND_DEVIATION, B));
    }
    EXPECT_LE(std::sqrt(Square), bound(Bounds, BOUND_RADIUS, B));
  }
}

TEST(BlockBounds, AreTight) {
  // Two means and fourteen between them.
  Scene S = Scene::sized(LINE_WORDS, 0);
  S.Means[0] = -1;
  S.Means[3] = 3;
  const std::vector<float> Bounds = blockBounds(S);
  EXPECT_EQ(Bounds[BOUND_CENTER], 1);
  EXPECT_NEAR(Bounds[BOUND_RADIUS], 2, 1e-4);
  EXPECT_NEAR(Bounds[BOUND_DEVIATION], 1, 1e-4);
}

TEST(BlockBounds, AreInfiniteWhereANumberIsNone) {
  for (const float Wrong : {std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity()}) {
    Scene S = randomScene();
    S.Means[3 * LINE_WORDS + 7] = Wrong;
    S.LogScales[6 * LINE_WORDS + 1] = Wrong;
    const std::vector<float> Bounds = blockBounds(S);
    EXPECT_TRUE(std::isfinite(bound(Bounds, BOUND_RADIUS, 0)));
    EXPECT_TRUE(std::isinf(bound(Bounds, BOUND_RADIUS, 1)));
    EXPECT_TRUE(std::isinf(bound(Bounds, BOUND_RADIUS, 2)));
    EXPECT_TRUE(std::isfinite(bound(Bounds, BOUND_RADIUS, 3)));
  }
}

} // namespace
