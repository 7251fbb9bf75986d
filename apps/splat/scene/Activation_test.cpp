#include "scene/Activation.h"
#include "scene/testing/SceneWriters.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

TEST(Activation, FollowsTheDefinitions) {
  Scene S = numberedScene(1, 0);
  S.LogScales = {0, 1, -20};
  S.Quats = {2, 0, 0, 0};
  S.OpacityLogits = {0};
  const auto A = activate<double>(S);
  EXPECT_EQ(A.Scales, (std::vector<double>{1, std::exp(1.0), std::exp(-20.0)}));
  EXPECT_EQ(A.Quats, (std::vector<double>{1, 0, 0, 0}));
  EXPECT_EQ(A.Opacities, (std::vector<double>{0.5}));
}

TEST(Activation, IsRoundedOnceFromDouble) {
  const Scene S = numberedScene(50, 0);
  const auto F = activate<float>(S);
  const auto D = activate<double>(S);
  for (std::size_t I = 0; I < D.Scales.size(); ++I)
    EXPECT_EQ(F.Scales[I], static_cast<float>(D.Scales[I]));
  for (std::size_t I = 0; I < D.Quats.size(); ++I)
    EXPECT_EQ(F.Quats[I], static_cast<float>(D.Quats[I]));
  for (std::size_t I = 0; I < D.Opacities.size(); ++I)
    EXPECT_EQ(F.Opacities[I], static_cast<float>(D.Opacities[I]));
}

TEST(Activation, ExtremesStayDefined) {
  Scene S = numberedScene(2, 0);
  S.Quats = {0, 0, 0, 0, 1e-30F, 0, 0, 1e-30F};
  S.OpacityLogits = {1000, -1000};
  const auto A = activate<float>(S);
  EXPECT_EQ(A.Opacities, (std::vector<float>{1, 0}));
  EXPECT_EQ(A.Quats[0], 0);
  EXPECT_FLOAT_EQ(A.Quats[4], std::sqrt(0.5F));
}

TEST(Activation, InfinitiesWithAMeaningAreResolved) {
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  Scene S = numberedScene(3, 0);
  const Scene Before = S;
  S.OpacityLogits = {Infinity, -Infinity, 2};
  S.LogScales[4] = -Infinity;
  S.LogScales[5] = Infinity;
  S.Means[0] = -Infinity;
  resolveInfinities(S);
  const auto A = activate<float>(S);
  EXPECT_EQ(A.Opacities[0], 1);
  EXPECT_LT(A.Opacities[1], 1e-12F);
  EXPECT_EQ(S.OpacityLogits[2], 2);
  EXPECT_NEAR(A.Scales[4], std::numeric_limits<float>::min(), 1e-43);
  EXPECT_EQ(S.LogScales[3], Before.LogScales[3]);
  // These have none.
  EXPECT_EQ(S.LogScales[5], Infinity);
  EXPECT_EQ(S.Means[0], -Infinity);
}

} // namespace
