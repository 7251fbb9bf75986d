#include "scene/Activation.h"
#include "scene/Statistics.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

TEST(Statistics, AreThoseOfTheActivatedParameters) {
  Scene S = Scene::sized(3, 0);
  S.Means = {-1, 0, 5, 2, 0, 6, 4, -3, 7};
  S.LogScales = {0, 0, 0, std::log(2.0F), 0, 0, std::log(8.0F), 0, 0};
  S.OpacityLogits = {opacityLogit(0.5), opacityLogit(0.001),
                     opacityLogit(0.75)};
  const auto R = statisticsOf(S);
  EXPECT_EQ(R.Low, (std::array<double, 3>{-1, -3, 5}));
  EXPECT_EQ(R.High, (std::array<double, 3>{4, 0, 7}));
  EXPECT_NEAR(R.Opacity.Median, 0.5, 1e-6);
  EXPECT_NEAR(R.Opacity.Mean, 1.251 / 3, 1e-6);
  EXPECT_NEAR(R.Opacity.Largest, 0.75, 1e-6);
  EXPECT_NEAR(R.Transparent, 1.0 / 3, 1e-12);
  EXPECT_NEAR(R.LargestScale.Median, 2, 1e-6);
  EXPECT_NEAR(R.AxisRatio.Largest, 8, 1e-5);
}

TEST(Statistics, StraysAreOutsideTheInnerBounds) {
  Scene S = Scene::sized(201, 0);
  for (std::size_t I = 0; I < 200; ++I)
    S.Means[3 * I] = static_cast<float>(I);
  S.Means[600] = 1e6F;
  const auto R = statisticsOf(S);
  EXPECT_EQ(R.High[0], 1e6);
  EXPECT_EQ(R.InnerLow[0], 2);
  EXPECT_EQ(R.InnerHigh[0], 198);
}

TEST(Statistics, AnOpacityOf1In255IsNotBelowIt) {
  Scene S = Scene::sized(2, 0);
  S.OpacityLogits = {opacityLogit(1 / 255.0), opacityLogit(0.9 / 255)};
  EXPECT_EQ(statisticsOf(S).Transparent, 0.5);
}

} // namespace
