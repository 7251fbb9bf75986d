#include "render/PixelLists.h"

#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

/// A picture of one pixel, with Gaussians of these opacities in its middle from
/// front to back, at depths 1, 2 and so on; records are turned round, and each
/// stands twice.
PixelLists pixelOf(const std::vector<float> &Opacities) {
  const auto Count = static_cast<uint32_t>(Opacities.size());
  PixelLists L;
  L.Size = {1, 1};
  L.TileSize = {64, 64};
  L.Stride = Count;
  L.Records.resize(2 * std::size_t{Count});
  L.Depths.resize(2 * std::size_t{Count});
  for (uint32_t I = 0; I < Count; ++I) {
    const uint32_t Record = 2 * Count - 1 - I;
    splat_gaussian &G = L.Records[Record];
    G.mean[0] = G.mean[1] = 0.5F;
    G.conic[0] = G.conic[2] = 1;
    G.extent[0] = G.extent[1] = 1;
    G.opacity = Opacities[I];
    L.Depths[Record] = static_cast<float>(I + 1);
    L.List.push_back(Record);
  }
  L.Ranges = {{0, Count}};
  return L;
}

float medianOf(const std::vector<float> &Opacities) {
  return medianDepths(pixelOf(Opacities), RenderOptions()).front();
}

TEST(PixelLists, TheLargestWeightsComeFirst) {
  // Weights 0.25, 0.375, 0.1875, 0.09375; then one that is not blended.
  const PixelLists L = pixelOf({0.25F, 0.5F, 0.5F, 0.5F, 0.001F});
  const auto Two = topContributors(L, RenderOptions(), 2);
  EXPECT_EQ(Two.Indices, (std::vector<int32_t>{3, 4}));
  EXPECT_EQ(Two.Weights, (std::vector<float>{0.375F, 0.25F}));
  EXPECT_EQ(Two.Counts, std::vector<int32_t>{4});
  const auto Six = topContributors(L, RenderOptions(), 6);
  EXPECT_EQ(Six.Indices, (std::vector<int32_t>{3, 4, 2, 1, -1, -1}));
  EXPECT_EQ(Six.Weights,
            (std::vector<float>{0.375F, 0.25F, 0.1875F, 0.09375F, 0, 0}));
}

TEST(PixelLists, TheMedianIsWhereHalfOfTheLightIsLeft) {
  EXPECT_EQ(medianOf({0.75F, 0.75F}), 1);
  EXPECT_EQ(medianOf({0.5F, 0.75F}), 1);
  EXPECT_EQ(medianOf({0.25F, 0.25F, 0.25F, 0.25F}), 3);
  EXPECT_EQ(medianOf({0.125F, 0.125F}), 2);
  EXPECT_EQ(medianOf({}), 0);
}

TEST(PixelLists, TheMedianOfASurfelIsWhereTheRayMeetsIt) {
  // The pixel is 2 px right of the mean, where the plane is 1.5 times as near.
  PixelLists L = pixelOf({0.9F, 0.9F});
  RenderOptions O;
  O.Kind = RendererKind::Surfel;
  for (const splat_gaussian &G : L.Records) {
    splat_ray_gaussian R{};
    R.mean[0] = -2;
    R.factor[0] = R.factor[2] = 0.1F;
    R.slope[0] = 0.25F;
    R.opacity = G.opacity;
    L.Rays.push_back(R);
  }
  EXPECT_FLOAT_EQ(medianDepths(L, O).front(), 1 / 1.5F);
  // From the edge the low pass alone has it, and the depth is the mean's.
  for (splat_ray_gaussian &R : L.Rays)
    R.factor[0] = 1e6F, R.mean[0] = 0.5F;
  EXPECT_EQ(medianDepths(L, O).front(), 1);
  // Its box ends before the pixel.
  for (splat_ray_gaussian &R : L.Rays)
    R.first = 1;
  EXPECT_EQ(medianDepths(L, O).front(), 0);
}

} // namespace
