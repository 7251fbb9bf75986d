#include "demo/BenchmarkScene.h"

#include "demo/PortableMath.h"
#include "scene/Scene.h"

#include <cmath>
#include <gtest/gtest.h>

namespace vorion::splat::demo {
namespace {

TEST(PortableMath, IsTheLibrarysButForItsLastBits) {
  for (double X = -30; X < 30; X += 0.37) {
    EXPECT_NEAR(portableExp(X) / std::exp(X), 1, 1e-14) << X;
    EXPECT_NEAR(portableLog(std::exp(X)), X, 1e-14 * std::abs(X) + 1e-15) << X;
    const auto [C, S] = portableCosSin(X);
    EXPECT_NEAR(C, std::cos(2 * std::numbers::pi * X), 1e-13) << X;
    EXPECT_NEAR(S, std::sin(2 * std::numbers::pi * X), 1e-13) << X;
  }
  EXPECT_NEAR(portablePower(2, 0.5), std::numbers::sqrt2, 1e-15);
}

TEST(BenchmarkScene, HasExactlyAsManyGaussiansAsAskedFor) {
  for (const BenchmarkKind K : BenchmarkKinds)
    for (const int Count : {1000, 10007}) {
      const Scene S = makeBenchmark(K, benchmarkShape(K, Count), Count);
      ASSERT_EQ(S.size(), static_cast<std::size_t>(Count)) << name(K);
      EXPECT_TRUE(checkFinite("", S)) << name(K);
      // The last one is there, too.
      EXPECT_NE(S.Quats.back() * S.Quats.back() +
                    S.Quats[S.Quats.size() - 4] * S.Quats[S.Quats.size() - 4],
                0)
          << name(K);
    }
}

TEST(BenchmarkScene, LeavesOutWhatIsNotThere) {
  BenchmarkShape Shape = benchmarkShape(BenchmarkKind::Outdoor, 1000);
  Shape.Behind = Shape.Nowhere = 0;
  const Scene S = makeBenchmark(BenchmarkKind::Outdoor, Shape, 2000);
  // The wood behind begins 13 m from the middle, the lawn ends at 14.
  for (std::size_t I = 0; I < S.size(); ++I)
    EXPECT_GT(S.Means[3 * I + 2], -14.5F);
}

TEST(BenchmarkScene, HasOtherPlacesWithAnotherSeed) {
  const BenchmarkShape &Shape = benchmarkShape(BenchmarkKind::Object, 1000);
  const Scene First = makeBenchmark(BenchmarkKind::Object, Shape, 1000),
              Other = makeBenchmark(BenchmarkKind::Object, Shape, 1000, 1);
  EXPECT_EQ(makeBenchmark(BenchmarkKind::Object, Shape, 1000, 0).Means,
            First.Means);
  ASSERT_EQ(Other.size(), First.size());
  EXPECT_NE(Other.Means, First.Means);
}

TEST(BenchmarkScene, MovesEachCameraByItsOwnFactor) {
  const std::array<double, 3> At = {1, 1, 1}, Farther = {1, 2, 1};
  for (const BenchmarkKind K : BenchmarkKinds) {
    const auto Near = benchmarkCameras(K, At),
               Far = benchmarkCameras(K, Farther);
    EXPECT_EQ(Near[0].Position, Far[0].Position) << name(K);
    EXPECT_NE(Near[1].Position, Far[1].Position) << name(K);
    EXPECT_EQ(Near[1].Rotation, Far[1].Rotation) << name(K);
    EXPECT_EQ(Near[2].Position, Far[2].Position) << name(K);
  }
}

} // namespace
} // namespace vorion::splat::demo
