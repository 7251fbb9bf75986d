#include "analyze/Analysis.h"

#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::splat;
using reference::Support;

namespace {

/// A camera at the origin that looks along z, its axis at pixel (64, 64); a
/// Gaussian at depth 1 is as many pixels wide as its scale times 100.
reference::Camera<float> camera() {
  reference::Camera<float> C;
  C.Width = C.Height = 256;
  C.Rotation = glm::mat3(1);
  C.Translation = C.Centre = glm::vec3(0);
  C.Focal = {100, 100};
  C.Principal = {64, 64};
  return C;
}

/// Adds a round Gaussian whose mean is at pixel (\p X, \p Y).
void add(reference::Gaussians<float> &G, float X, float Y, float Z, float Scale,
         float Opacity) {
  G.Means.emplace_back((X - 64) / 100 * Z, (Y - 64) / 100 * Z, Z);
  G.Scales.emplace_back(Scale);
  G.Quats.emplace_back(1, 0, 0, 0);
  G.Opacities.push_back(Opacity);
  G.Colors.emplace_back(1);
}

TEST(Analysis, PairsOfOneGaussianAreTheTilesOfItsBox) {
  reference::Gaussians<float> G;
  // Variance 10^2 + 0.3, so that three sigma are 30.04 and the square's 31.
  add(G, 64, 64, 1, 0.1F, 0.9F);
  reference::Options O;
  O.Reach = Support::Box3;
  const Analysis A = analyze(G, camera(), O);
  // 33.96 to 94.04: columns 2 to 5 of 16 pixels, 1 to 2 of 32, 0 to 1 of 64.
  EXPECT_EQ(A.BySupport[1], (Invocations{16, 4, 4, 1}));
  // 33 to 95 is in the same tiles.
  EXPECT_EQ(A.BySupport[2], (Invocations{16, 4, 4, 1}));
  EXPECT_EQ(A.Visible, 1U);
  EXPECT_EQ(A.Lists[0].Tiles, 256U);
  EXPECT_EQ(A.Lists[0].Empty, 240U);
  EXPECT_EQ(A.Lists[0].Longest, 1U);
  EXPECT_EQ(A.Lists[0].Histogram, (std::vector<uint64_t>{240, 16}));
  EXPECT_EQ(A.Lists[2].Mean, 4.0 / 16);
  EXPECT_EQ(A.Saturated, 0U);
  EXPECT_EQ(A.Lists[0].Occluded[100], 0);
  EXPECT_EQ(reduction(A.BySupport[1], 0, 2), 0.75);
}

TEST(Analysis, PixelsAreOccludedWhereTheirListHasStoppedThem) {
  // Ten of alpha 0.99: the first leaves 1 % of the light, the second would
  // leave a hundredth of that.
  reference::Gaussians<float> G;
  for (int I = 0; I < 10; ++I)
    add(G, 64, 64, 1 + 0.01F * static_cast<float>(I), 100, 1);
  reference::Options O;
  O.Cutoff = 1e-3;
  const Analysis A = analyze(G, camera(), O);
  EXPECT_EQ(A.Saturated, A.Pixels);
  EXPECT_EQ(A.Covered, A.Pixels);
  for (const ListStatistics &L : A.Lists) {
    EXPECT_EQ(L.Occluded[10], 0);
    EXPECT_EQ(L.Occluded[30], 1);           // the third of ten entries
    EXPECT_EQ(L.Histogram.back(), L.Tiles); // 8 to 15 entries
    EXPECT_EQ(L.Histogram.size(), 5U);
    EXPECT_EQ(L.Filled.Count, L.Tiles);
    EXPECT_EQ(L.Filled.Mean, 10);
    EXPECT_EQ(L.Filled.Percentiles[95], 10);
  }
  // One is blended, the next ends the pixel.
  EXPECT_EQ(A.BlendsEach.Count, A.Pixels);
  EXPECT_EQ(A.BlendsEach.Mean, 1);
  EXPECT_EQ(A.WalkedEach.Percentiles[50], 2);
  EXPECT_EQ(A.Alpha.Count, A.Blends);
  EXPECT_NEAR(A.Alpha.Mean, 0.99, 1e-6);
  EXPECT_NEAR(A.Alpha.Percentiles[0], 0.99, 3e-3); // a bin's width
}

TEST(Analysis, NothingSeenIsNothingCounted) {
  reference::Gaussians<float> G;
  add(G, 64, 64, -1, 0.1F, 1);
  const Analysis A = analyze(G, camera(), {});
  EXPECT_EQ(A.Visible, 0U);
  for (const Invocations &I : A.BySupport)
    EXPECT_EQ(I, (Invocations{}));
  EXPECT_EQ(reduction(A.BySupport[0], 0, 2), 0);
  EXPECT_EQ(A.MeanTransmittance, 1);
  for (const Distribution &D : {A.BlendsEach, A.WalkedEach, A.Alpha})
    EXPECT_EQ(D.Count, 0U);
}

} // namespace
