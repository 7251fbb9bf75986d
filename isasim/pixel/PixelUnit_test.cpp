// Hand-overs: what is handed, that the picture keeps its bits, the work counted
// pixel by pixel, status codes, what the agent shows.
#include "pixel/PixelUnit.h"
#include "raster/RasterTest.h"

#include <cmath>
#include <limits>
#include <random>

namespace vorion::pixel {
namespace {

using namespace raster;

class PixelUnitTest : public RasterTest {
protected:
  static constexpr uint32_t Record = Records + 0x700000;

  PixelUnit Tails{Memory};

  /// Lets the rasterizer hand over what it has.
  void rasterize() {
    Unit.finish(Agent);
    Tails.accept(Unit.takeHandOvers());
  }
  uint32_t startAll() {
    set(Csr::Start, 1U);
    rasterize();
    while (Tails.step()) {
    }
    return Agent.read(Csr::Wait, 0);
  }
  void handOverAt(uint32_t Count, uint32_t Share = 0) {
    set(Csr::TailCount, Count);
    set(Csr::TailShare, Share);
    set(Csr::TailRecord, Record);
  }
  Tail record() { return Memory.get<Tail>(Record, 1)[0]; }

  /// \p Count Gaussians of many sizes and opacities around a tile.
  std::vector<Gaussian> randomScene(unsigned Count) {
    std::mt19937 Random{Count};
    std::uniform_real_distribution<float> Place(-10, 74), Size(1, 25),
        Opacity(0.02F, 1.2F), Colour(0, 1);
    std::vector<Gaussian> Scene;
    for (unsigned I = 0; I != Count; ++I)
      Scene.push_back(roundGaussian(Place(Random), Place(Random), Size(Random),
                                    Opacity(Random), Colour(Random),
                                    Colour(Random), Colour(Random)));
    return Scene;
  }
};

/// Of constant alpha \p Opacity in columns [0, Width).
Gaussian band(float Width, float Opacity) {
  return {{Width / 2, 32}, {0, 0, 0}, Opacity, {1, 2, 3}, {Width / 2, 64}, 0};
}

TEST_F(PixelUnitTest, PicturesKeepTheirBits) {
  const std::vector<Gaussian> Scene = randomScene(400);
  const TileCommand Tiles[] = {
      {},
      {.Width = 37, .Height = 21},
      {.Cutoff = 0},
      {.Cutoff = 0.2F, .Options = OptionsStopAtEqual.put(1)},
      {.Options = OptionsExp.put(1) | OptionsSkipSaturated.put(1)}};
  const std::pair<uint32_t, uint32_t> Reasons[] = {
      {1, 0}, {37, 0},   {100, 0},   {399, 0},   {400, 0},   {~0U, 0},
      {0, 1}, {0, 6553}, {0, 32768}, {0, 60000}, {0, 65536}, {50, 45000}};
  unsigned HandedOver = 0;
  for (const TileCommand &Tile : Tiles) {
    handOverAt(0);
    const std::vector<Pixel> Alone = render(Scene, Tile);
    const Counters Whole = Agent.counters();
    for (const auto &[Count, Share] : Reasons) {
      const Counters Before = Agent.counters();
      configure(Scene, Tile);
      handOverAt(Count, Share);
      ASSERT_EQ(startAll(), VR_OK);
      EXPECT_EQ(pixels(Tile.Width, Tile.Height), Alone)
          << Count << ' ' << Share;
      HandedOver += Agent.counters().Tails - Before.Tails;
    }
    EXPECT_GT(Whole.Blends, 0U);
  }
  EXPECT_GT(HandedOver, 30U);
}

// Pixels whose ranges begin and end in front of the hand-over and behind it.
TEST_F(PixelUnitTest, RangesKeepTheirBits) {
  const std::vector<Gaussian> Scene = randomScene(90);
  constexpr uint32_t From = Record + 0x1000, To = Record + 0x4000;
  std::mt19937 Random{7};
  std::vector<uint32_t> Words(2048);
  for (const uint32_t At : {From, To}) {
    for (uint32_t &W : Words)
      W = Random() % 100;
    Memory.put(At, std::span<const uint32_t>(Words));
  }
  const TileCommand Tile{.Cutoff = 0.2F, .X = 3, .Height = 32};
  const auto Draw = [&](uint32_t Mode, uint32_t Count, uint32_t Share) {
    Memory.put(Pixels, std::span<const Pixel>(
                           std::vector<Pixel>(2048, Pixel{1, 2, 3, 0.5F})));
    configure(Scene, Tile);
    set(Csr::Mode, Mode);
    for (const auto &[Number, Value] : {std::pair{VR_WORD_FROM, From},
                                        {VR_WORD_LIMIT, To},
                                        {VR_WORD_LIMIT_FIRST, 4U}}) {
      set(Csr::Index, Number);
      set(Csr::Word, Value);
    }
    handOverAt(Count, Share);
    EXPECT_EQ(startAll(), VR_OK);
    return pixels(64, 32);
  };
  const uint32_t Modes[] = {ModeLimited.put(1),
                            ModeFrom.put(1) | ModeLoad.put(1),
                            ModeKeepSaturated.put(1),
                            ModeFrom.put(1) | ModeLimited.put(1) |
                                ModeLoad.put(1) | ModeKeepSaturated.put(1)};
  for (const uint32_t Mode : Modes) {
    const std::vector<Pixel> Alone = Draw(Mode, 0, 0);
    const std::pair<uint32_t, uint32_t> Reasons[] = {
        {1, 0}, {30, 0}, {75, 0}, {90, 0}, {0, 1}, {0, 20000}, {0, 60000}};
    for (const auto &[Count, Share] : Reasons)
      EXPECT_EQ(Draw(Mode, Count, Share), Alone) << Mode << ' ' << Count;
  }
  EXPECT_GT(Agent.counters().Tails, 12U);
  // What follows the record is checked, too.
  configure(Scene, {.Cutoff = 0, .Height = 32});
  set(Csr::Mode, Modes[0]);
  handOverAt(30);
  set(Csr::Start, 1U);
  rasterize();
  const TailRange Range = Memory.get<TailRange>(Record + sizeof(Tail), 1)[0];
  EXPECT_EQ(Range.LimitFirst, 4 + 60U);
  EXPECT_EQ(Range.Mode, ModeLimited.put(1));
  for (const TailRange Spoilt : {TailRange{ModeBackward.put(1), To, 0, 0},
                                 {ModeLimited.put(1), 2, 0, 0},
                                 {ModeFrom.put(1), To, 0, 0}}) {
    set(Csr::Start, 1U);
    rasterize();
    Memory.put(Record + sizeof(Tail), std::span(&Spoilt, 1));
    while (Tails.step()) {
    }
    EXPECT_NE(Agent.read(Csr::Wait, 0), VR_OK) << Spoilt.Mode;
  }
}

TEST_F(PixelUnitTest, BlendsAreShared) {
  const std::vector<Gaussian> Scene = randomScene(300);
  render(Scene, {.Cutoff = 0});
  const Counters Alone = Agent.counters();
  configure(Scene, {.Cutoff = 0});
  handOverAt(120);
  ASSERT_EQ(startAll(), VR_OK);
  EXPECT_EQ(Agent.counters().Gaussians - Alone.Gaussians, 180U);
  EXPECT_EQ(Agent.counters().Blends - Alone.Blends +
                Agent.counters().TailBlends,
            Alone.Blends);
  EXPECT_GT(Agent.counters().TailBlends, 0U);
}

// 20 x 10 pixels. 0.99 blends, the second of the same pixel saturates it.
TEST_F(PixelUnitTest, RecordAndCountersOfAKnownList) {
  const Gaussian Scene[] = {band(8, 0.99F),  band(8, 0.99F), band(12, 0.99F),
                            band(12, 0.99F), band(20, 0.5F), band(20, 0.5F)};
  configure(Scene, {.Cutoff = 0.005F, .X = 0, .Width = 20, .Height = 10});
  Memory.put<uint32_t>(List,
                       std::vector<uint32_t>{0, 1, VR_INTERSECT | 2, 3, 4, 5});
  set(Csr::Ztile, ZtileCount.put(3) | ZtileIndex.put(1));
  handOverAt(0, 65536 * 2 / 5); // 8 of 20 columns
  set(Csr::Start, 1U);
  rasterize();

  const Tail T = record();
  EXPECT_EQ(T.Rest.List, List + 8);
  EXPECT_EQ(T.Rest.Count, 4U);
  EXPECT_EQ(T.Rest.Gaussians, Records);
  EXPECT_EQ(T.Rest.Output, Pixels);
  EXPECT_EQ(T.Rest.OutputPitch, Pitch);
  EXPECT_EQ(T.Rest.Ztile, ZtileCount.put(3) | ZtileIndex.put(1));
  EXPECT_EQ(T.LiveCount, 120U);
  for (unsigned Row = 0; Row != 64; ++Row) {
    EXPECT_EQ(T.Live[2 * Row], Row < 10 ? 0xfff00U : 0U);
    EXPECT_EQ(T.Live[2 * Row + 1], 0U);
  }
  EXPECT_EQ(Agent.counters(), (Counters{1, 2, 0, 160, 80}));
  // The saturated pixels are done, the others as they were.
  EXPECT_EQ(pixels(20, 10)[7].R, 0.99F);
  EXPECT_EQ(pixels(20, 10)[8], (Pixel{0, 0, 0, 1}));

  EXPECT_TRUE(Tails.step());
  EXPECT_FALSE(Tails.step());
  EXPECT_EQ(pixels(20, 10)[8].R, 0.99F);
  EXPECT_EQ(pixels(20, 10)[12], (Pixel{0.75F, 1.5F, 2.25F, 0.25F}));
  // Columns 8 to 11 see two Gaussians and are saturated by the second; the
  // last 8 columns see all four and blend two.
  const Counters &Sum = Agent.counters();
  EXPECT_EQ(Sum.Tails, 1U);
  EXPECT_EQ(Sum.TailPixels, 120U);
  EXPECT_EQ(Sum.TailVisits, 40U * 2 + 80U * 4);
  EXPECT_EQ(Sum.TailBlends, 40U * 1 + 80U * 2);
}

TEST_F(PixelUnitTest, VisitsAreThoseOfALoopOverPixels) {
  std::mt19937 Random{5};
  std::vector<Gaussian> Scene;
  for (int I = 0; I != 60; ++I) {
    const auto At = static_cast<float>(Random() % 64);
    const auto Extent = static_cast<float>(Random() % 40);
    Scene.push_back({{At, 32}, {0, 0, 0}, 0.6F, {1, 1, 1}, {Extent, 99}, 0});
  }
  const unsigned First = 15;
  configure(Scene, {.Cutoff = 0.01F, .Height = 1});
  handOverAt(static_cast<uint32_t>(Scene.size()) - First);
  ASSERT_EQ(startAll(), VR_OK);
  uint64_t Visits = 0;
  for (unsigned X = 0; X != 64; ++X) {
    float T = 1;
    bool Open = true;
    for (unsigned I = 0; I != Scene.size() && Open; ++I) {
      Visits += I >= First;
      const Gaussian &G = Scene[I];
      if (std::fabs(static_cast<float>(X) + 0.5F - G.Mean[0]) > G.Extent[0])
        continue;
      const float Next = T * (1 - 0.6F);
      Open = Next >= 0.01F;
      T = Open ? Next : T;
    }
  }
  EXPECT_EQ(Agent.counters().TailVisits, Visits);
}

TEST_F(PixelUnitTest, SaturatedTilesAndEmptyListsAreNotHandedOver) {
  const std::vector<Gaussian> Opaque(4, band(64, 0.99F));
  configure(Opaque, {.Cutoff = 0.005F});
  handOverAt(2);
  ASSERT_EQ(startAll(), VR_OK);
  configure({});
  handOverAt(2, 1);
  ASSERT_EQ(startAll(), VR_OK);
  EXPECT_EQ(Agent.counters().Tails, 0U);
  EXPECT_EQ(Agent.counters().Commands, 2U);
}

TEST_F(PixelUnitTest, AgentIsBusyUntilTheTailIsDone) {
  const std::vector<Gaussian> Scene = randomScene(40);
  configure(Scene);
  handOverAt(10);
  set(Csr::Start, 1U);
  EXPECT_EQ(Agent.read(Csr::Status, 0), StatusBusy.put(1));
  rasterize();
  EXPECT_TRUE(Agent.isBusy());
  EXPECT_TRUE(Agent.canStart());
  EXPECT_EQ(Agent.read(Csr::Status, 0), StatusBusy.put(1) | StatusTail.put(1));
  EXPECT_TRUE(Tails.step());
  EXPECT_FALSE(Agent.isBusy());
  EXPECT_EQ(Agent.read(Csr::Status, 0), 0U);
}

TEST_F(PixelUnitTest, StatusCodesOfAHandOver) {
  const std::vector<Gaussian> Scene = randomScene(20);
  configure(Scene);
  handOverAt(0, 65537);
  EXPECT_EQ(startAll(), VR_BAD_TAIL);
  handOverAt(5);
  set(Csr::TailRecord, Record + 8);
  EXPECT_EQ(startAll(), VR_MISALIGNED);
  set(Csr::TailRecord, 0xffff0000U);
  EXPECT_EQ(startAll(), VR_UNMAPPED);
  set(Csr::TailRecord, TestMemory::Base + (8U << 20) - 544);
  EXPECT_EQ(startAll(), VR_UNMAPPED);
  for (const uint32_t Mode : {ModePushed.put(1), ModeDrain.put(1)}) {
    handOverAt(5);
    set(Csr::Mode, Mode);
    EXPECT_EQ(startAll(), VR_BAD_TAIL);
  }
  // Without a reason the record does not matter.
  set(Csr::Mode, 0U);
  handOverAt(0);
  set(Csr::TailRecord, 1U);
  EXPECT_EQ(startAll(), VR_OK);
}

TEST_F(PixelUnitTest, BadEntryOfTheTail) {
  std::vector<Gaussian> Scene = randomScene(20);
  Scene[15].Opacity = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Pixel> Front =
      render(std::span<const Gaussian>(Scene).first(10));
  configure(Scene);
  handOverAt(10);
  EXPECT_EQ(startAll(), VR_NAN);
  // The live pixels stay as they were handed over.
  EXPECT_EQ(pixels(), Front);
}

// The record lies in memory, where a program can spoil it.
TEST_F(PixelUnitTest, SpoiltRecordsAreStatusCodes) {
  const std::vector<Gaussian> Scene = randomScene(20);
  const std::pair<uint32_t TileWords::*, uint32_t> Spoilt[] = {
      {&TileWords::TileShape, 0x00400041},
      {&TileWords::Options, OptionsExp.mask()},
      {&TileWords::List, 0xffff0000},
      {&TileWords::Count, ~0U},
      {&TileWords::Output, 0},
      {&TileWords::Cutoff, 0x7fc00000},
      {&TileWords::Gaussians, 0xfffffff0}};
  for (const auto &[Member, Value] : Spoilt) {
    configure(Scene);
    handOverAt(10);
    set(Csr::Start, 1U);
    rasterize();
    Tail T = record();
    T.Rest.*Member = Value;
    Memory.put<Tail>(Record, std::span(&T, 1));
    EXPECT_TRUE(Tails.step());
    EXPECT_NE(Agent.read(Csr::Wait, 0), VR_OK) << Value;
  }
}

} // namespace
} // namespace vorion::pixel
