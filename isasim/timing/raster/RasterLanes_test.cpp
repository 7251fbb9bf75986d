#include "testing/Boxes.h"
#include "timing/raster/RasterLanes.h"

#include <gtest/gtest.h>

using namespace vorion::isasim;
using vorion::raster::GaussianWork;

namespace {

TEST(RasterLanes, ABoxTakesThePixelsOverTheLanes) {
  RasterLanes Lanes(TimingConfig().Raster);
  const auto Forward = Lanes.passageOf(box(0, 0, 64, 2), false);
  EXPECT_EQ(Forward.Cycles, 8U);
  EXPECT_EQ(Forward.Slots, 128U);
  EXPECT_EQ(Forward.BlockRows, 0U);
  EXPECT_EQ(Lanes.passageOf(box(0, 0, 64, 2), true).Cycles, 16U);
}

TEST(RasterLanes, PixelsWithoutASlotArePackedAway) {
  RasterLanes Lanes(TimingConfig().Raster);
  GaussianWork G = box(0, 0, 64, 2);
  G.Slots = 17;
  EXPECT_EQ(Lanes.passageOf(G, false).Cycles, 2U);
  G.Slots = 0;
  EXPECT_EQ(Lanes.passageOf(G, false).Cycles, 1U);
}

TEST(RasterLanes, ABlockThatIsLeftTakesACycle) {
  RasterTiming Skips = TimingConfig().Raster;
  Skips.SkipBlocks = 3;
  RasterLanes Lanes(Skips);
  GaussianWork G = box(2, 2, 16, 16); // in 5 rows of blocks
  G.Blocks = 6;
  G.ChosenPixels = 60;
  const auto P = Lanes.passageOf(G, false);
  EXPECT_EQ(P.BlockRows, 5U);
  EXPECT_EQ(P.Cycles, 6U);
  EXPECT_EQ(P.Slots, 60U);
}

TEST(RasterLanes, APixelIsReadWhenTheBoxBeforeHasUpdatedIt) {
  RasterTiming Slow = TimingConfig().Raster;
  Slow.UpdateCycles = 5;
  RasterLanes Lanes(Slow);
  Lanes.enter(box(3, 3, 1, 1), 10, 1);
  EXPECT_EQ(Lanes.safeAt(box(3, 3, 1, 1), 1, 11), 15U);
  EXPECT_EQ(Lanes.safeAt(box(4, 3, 1, 1), 1, 11), 11U) << "beside it";
  Lanes.clear();
  EXPECT_EQ(Lanes.safeAt(box(3, 3, 1, 1), 1, 11), 11U);
}

} // namespace
