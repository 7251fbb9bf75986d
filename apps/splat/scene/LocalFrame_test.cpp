#include "scene/LocalFrame.h"

#include "scene/formats/Ply.h"
#include "scene/testing/SceneWriters.h"

#include <gtest/gtest.h>

using namespace vorion::splat;
using vorion::splat::testing::numberedScene;

namespace {

/// Moved by \p By in double.
Scene moved(Scene S, const WorldPoint &By) {
  for (std::size_t I = 0; I < S.Means.size(); ++I)
    S.setMean(I, S.Means[I] + By[I % 3]);
  return S;
}

TEST(LocalFrame, FarScenesOfDoublesAreMeasuredNearby) {
  const Scene Home = numberedScene(50, 1);
  const WorldPoint Far{412345.625, 5654321.25, 120};
  Scene S = moved(Home, Far);
  ASSERT_TRUE(needsDoubles(S));
  recentre(S, {});
  ASSERT_NE(S.Origin, WorldPoint{});
  for (std::size_t I = 0; I < S.Means.size(); ++I) {
    EXPECT_NEAR(S.mean(I), Far[I % 3] + Home.Means[I], 1e-9);
    EXPECT_NEAR(S.Means[I], Far[I % 3] + Home.Means[I] - S.Origin[I % 3], 1e-4);
  }
  Scene Back = S;
  Back.setOrigin({});
  EXPECT_EQ(Back.Means, moved(Home, Far).Means);
}

TEST(LocalFrame, WhatFp32HoldsKeepsItsBits) {
  Scene S = numberedScene(50, 1);
  for (float &Mean : S.Means)
    Mean += 1e6F;
  const std::vector<float> Before = S.Means;
  EXPECT_FALSE(needsDoubles(S));
  recentre(S, {});
  EXPECT_EQ(S.Means, Before);
  Scene AtHome = moved(numberedScene(50, 1), {1e-9, 0, 0});
  ASSERT_FALSE(AtHome.MeanRests.empty());
  EXPECT_FALSE(needsDoubles(AtHome));
  recentre(AtHome, {});
  EXPECT_EQ(AtHome.Origin, WorldPoint{});
}

TEST(LocalFrame, PlyHasDoublesWhereFp32HasTooFewDigits) {
  const Scene Home = numberedScene(20, 0);
  EXPECT_EQ(formatPly(Home).find("double"), std::string::npos);
  Scene S = moved(Home, {412345.625, 5654321.25, 120});
  const std::string File = formatPly(S);
  EXPECT_NE(File.find("property double x\nproperty double y\nproperty double "
                      "z\nproperty float nx\n"),
            std::string::npos);
  recentre(S, {});
  EXPECT_EQ(formatPly(S), File);
}

} // namespace
