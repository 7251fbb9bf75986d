#include "picture/SceneUnit.h"

#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

/// Four at the distance \p R from the origin.
std::vector<Camera> ringOf(double R) {
  std::vector<Camera> Ring(4);
  Ring[0].Position = {R, 0, 0};
  Ring[1].Position = {-R, 0, 0};
  Ring[2].Position = {0, 0, R};
  Ring[3].Position = {0, 0, -R};
  return Ring;
}

TEST(SceneUnit, TheNearPlaneOfSmallScenesIsAShareOfTheirDistance) {
  const std::vector<WorldPoint> Points(50); // at the origin
  for (const double R : {1.0, 4.0, 1e6})
    for (const Rules By : {Rules::Inria, Rules::Gsplat})
      EXPECT_EQ(nearOfSmallScene(By, ringOf(R), Points), std::nullopt) << R;
  EXPECT_FLOAT_EQ(*nearOfSmallScene(Rules::Inria, ringOf(0.1), Points), 0.02F);
  EXPECT_FLOAT_EQ(*nearOfSmallScene(Rules::Gsplat, ringOf(0.1), Points),
                  0.001F);
  EXPECT_EQ(nearOfSmallScene(Rules::Inria, ringOf(1e-40), Points), 0x1p-126F);
}

TEST(SceneUnit, ForwardFacingCamerasAreAsFarAsTheirPoints) {
  const std::vector<WorldPoint> Points = {{0, 0, 3}, {0, 0, 4}, {0, 0, 1e6}};
  EXPECT_NEAR(viewingDistance(ringOf(0.05), Points), 4, 0.06);
  EXPECT_EQ(nearOfSmallScene(Rules::Inria, ringOf(0.05), Points), std::nullopt);
}

TEST(SceneUnit, WithoutPointsOrCamerasTheRulesStay) {
  const std::vector<WorldPoint> Point(1);
  EXPECT_EQ(nearOfSmallScene(Rules::Inria, ringOf(0.1), {}), std::nullopt);
  EXPECT_EQ(nearOfSmallScene(Rules::Inria, {}, Point), std::nullopt);
  EXPECT_EQ(nearOfSmallScene(Rules::Inria, {Camera()}, Point), std::nullopt);
}

} // namespace
