#include "io/LocalFrame.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

/// About \p Centre, within \p Radius.
std::vector<WorldPoint> cloud(const WorldPoint &Centre, double Radius) {
  return sampled(500, [&](std::size_t I) {
    WorldPoint P = Centre;
    for (std::size_t K = 0; K < 3; ++K)
      P[K] += Radius * std::sin(static_cast<double>(I * (K + 2)));
    return P;
  });
}

std::vector<Camera> oneAt(const WorldPoint &Place) {
  Camera C = Camera::ahead(100, 100, 120);
  C.Position = Place;
  return {C};
}

TEST(LocalFrame, AtHomeTheOriginStays) {
  for (const double Unit : {1e-9, 0.02, 1.0, 1e6}) {
    EXPECT_LT(pixelsLost(oneAt({0, 0, -4 * Unit}), cloud({}, Unit)), 1e-3);
    EXPECT_EQ(localOrigin(oneAt({0, 0, -4 * Unit}), cloud({}, Unit)),
              WorldPoint{});
    // Off the middle by some times the scene's size, too.
    EXPECT_EQ(localOrigin({}, cloud({9 * Unit, 0, -9 * Unit}, Unit)),
              WorldPoint{});
  }
}

TEST(LocalFrame, FarAwayItIsTheMiddleInFewDigits) {
  for (const WorldPoint &Far : {WorldPoint{2e4, -2e4, 2e4},
                                {2e5, 0, 0},
                                {412345.67, 5654321.89, 120.5},
                                {4000123.4, 900321.5, 4870456.7}})
    for (const bool Seen : {true, false}) {
      const auto Cameras =
          Seen ? oneAt({Far[0], Far[1], Far[2] - 4}) : std::vector<Camera>();
      const WorldPoint Origin = localOrigin(Cameras, cloud(Far, 2));
      for (std::size_t K = 0; K < 3; ++K) {
        EXPECT_NEAR(Origin[K], Far[K], 2);
        EXPECT_EQ(Origin[K], std::round(Origin[K]));
      }
      EXPECT_EQ(relativeTo(oneAt(Far), Origin)[0].Position[1],
                Far[1] - Origin[1]);
    }
}

TEST(LocalFrame, TheUnitDecidesWhatIsFar) {
  const WorldPoint Near{1, 2, 3};
  EXPECT_EQ(localOrigin({}, cloud(Near, 1)), WorldPoint{});
  EXPECT_NE(localOrigin({}, cloud(Near, 1e-3)), WorldPoint{});
}

TEST(LocalFrame, BackgroundsAndParallelRays) {
  // Far Gaussians are as far from the camera.
  EXPECT_EQ(localOrigin(oneAt({}), cloud({}, 1e6)), WorldPoint{});
  std::vector<Camera> C = oneAt({0, 0, -4});
  C[0].Optics.Model = lensModelNamed("ORTHOGRAPHIC");
  EXPECT_EQ(localOrigin(C, cloud({}, 1)), WorldPoint{});
  C[0].Fx = 1e6; // px a unit
  EXPECT_NE(localOrigin(C, cloud({5, 5, 5}, 1)), WorldPoint{});
}

TEST(LocalFrame, NothingIsAtHome) {
  EXPECT_EQ(localOrigin({}, {}), WorldPoint{});
  const std::vector<WorldPoint> One(1, {1e6, 0, 0});
  EXPECT_EQ(localOrigin(oneAt(One[0]), One), WorldPoint{});
}

} // namespace
