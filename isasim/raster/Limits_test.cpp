// Commands whose pixels take ranges of the list. The model is a command without
// ranges whose list is the range.
#include "raster/RasterTest.h"
#include "raster/UnitTables.h"

#include <cmath>
#include <random>
#include <tuple>

namespace vorion::raster {
namespace {

class LimitsTest : public RasterTest {
protected:
  static constexpr uint32_t Limits = Records + 0x700000;
  static constexpr uint32_t Lasts = Records + 0x720000;
  static constexpr uint32_t Froms = Records + 0x740000;
  /// Bytes of a row of limits.
  static constexpr uint32_t LimitPitch = Pitch / 4;

  void setWord(uint32_t Number, uint32_t Value) {
    set(Csr::Index, Number);
    set(Csr::Word, Value);
  }
  /// Sets the bank of a limited command, whose pixels have \p Each.
  void limit(const std::vector<uint32_t> &Each, const TileCommand &T,
             uint32_t First = 0) {
    for (unsigned Row = 0; Row != T.Height; ++Row)
      Memory.put(Limits + Row * LimitPitch,
                 std::span(Each).subspan(std::size_t{Row} * T.Width, T.Width));
    set(Csr::Mode, T.Mode | ModeLimited.put(1));
    setWord(VR_WORD_LIMIT, Limits);
    setWord(VR_WORD_LIMIT_FIRST, First);
  }
  /// Likewise, of a command whose pixels begin at \p Each.
  void beginAt(const std::vector<uint32_t> &Each, const TileCommand &T) {
    for (unsigned Row = 0; Row != T.Height; ++Row)
      Memory.put(Froms + Row * LimitPitch,
                 std::span(Each).subspan(std::size_t{Row} * T.Width, T.Width));
    set(Csr::Mode, Agent.read(Csr::Mode, 0) | ModeFrom.put(1));
    setWord(VR_WORD_FROM, Froms);
  }
  void addMode(uint32_t Bits) {
    set(Csr::Mode, Agent.read(Csr::Mode, 0) | Bits);
  }
  std::vector<uint32_t> lasts(const TileCommand &T) {
    std::vector<uint32_t> All;
    for (unsigned Row = 0; Row != T.Height; ++Row)
      for (const uint32_t L :
           Memory.get<uint32_t>(Lasts + Row * LimitPitch, T.Width))
        All.push_back(L);
    return All;
  }

  static std::vector<Gaussian> scene(unsigned Count) {
    std::mt19937 Random{Count};
    std::uniform_real_distribution<float> Place(-5, 50), Size(2, 20),
        Opacity(0.05F, 1), Colour(0, 1);
    std::vector<Gaussian> All;
    for (unsigned I = 0; I != Count; ++I)
      All.push_back(roundGaussian(Place(Random), Place(Random), Size(Random),
                                  Opacity(Random), Colour(Random),
                                  Colour(Random), Colour(Random)));
    return All;
  }
  static std::vector<uint32_t> someLimits(const TileCommand &T,
                                          uint32_t Largest) {
    std::mt19937 Random{Largest};
    std::vector<uint32_t> All(std::size_t{T.Width} * T.Height);
    for (uint32_t &L : All)
      L = Random() % (Largest + 1);
    All[0] = 0;
    All[1] = ~0U;
    return All;
  }
};

TEST_F(LimitsTest, PixelsAreThoseOfListsThatEndAtTheirLimits) {
  const std::vector<Gaussian> Scene = scene(30);
  const TileCommand Tiles[] = {
      {.Width = 64, .Height = 32},
      {.X = 3, .Y = 7, .Width = 32, .Height = 64},
      {.Cutoff = 0.2F,
       .Options = OptionsStopAtEqual.put(1),
       .Width = 17,
       .Height = 13},
      {.Options = OptionsExp.put(VR_EXP_TABLE) | OptionsSkipSaturated.put(1) |
                  OptionsBlend.put(1) | OptionsAlphaCutoff.put(2),
       .Width = 40,
       .Height = 40},
      {.Mode = ModeKeepLast.put(1), .Width = 45, .Height = 45}};
  for (const TileCommand &T : Tiles) {
    const std::vector<uint32_t> Each = someLimits(T, 35);
    set(Csr::Last, Lasts);
    configure(Scene, T);
    limit(Each, T);
    ASSERT_EQ(start(), VR_OK);
    const std::vector<Pixel> Limited = pixels(T.Width, T.Height);
    const std::vector<uint32_t> Last = lasts(T);
    for (uint32_t End = 0; End <= Scene.size(); ++End) {
      const std::vector<Pixel> Model = render(std::span(Scene).first(End), T);
      const std::vector<uint32_t> ModelLast = lasts(T);
      for (std::size_t P = 0; P != Each.size(); ++P) {
        if (std::min<std::size_t>(Each[P], Scene.size()) != End)
          continue;
        ASSERT_EQ(Limited[P], Model[P]) << P << ' ' << End;
        if (T.Mode)
          ASSERT_EQ(Last[P], ModelLast[P]) << P << ' ' << End;
      }
    }
  }
}

// The parts of a list see the limits of the whole.
TEST_F(LimitsTest, PartsOfAListCountFromTheirFirstEntry) {
  const std::vector<Gaussian> Scene = scene(24);
  const TileCommand T{.Cutoff = 0, .Width = 40, .Height = 20};
  const std::vector<uint32_t> Each = someLimits(T, 24);
  const std::span Rest = std::span(Scene).subspan(10);
  configure(Rest, T);
  limit(Each, T, 10);
  set(Csr::Ztile, ZtileIndex.put(1) | ZtileCount.put(2));
  ASSERT_EQ(start(), VR_OK);
  const std::vector<Pixel> Part = pixels(T.Width, T.Height);
  std::vector<uint32_t> FromTen = Each;
  for (uint32_t &L : FromTen)
    L -= std::min(L, 10U);
  configure(Rest, T);
  limit(FromTen, T);
  ASSERT_EQ(start(), VR_OK);
  EXPECT_EQ(pixels(T.Width, T.Height), Part);
}

TEST_F(LimitsTest, ATileEndsAtItsLargestLimit) {
  const std::vector<Gaussian> Scene(9, flatGaussian(8, 8, 100, 100, 0.25F));
  const TileCommand T{.Width = 4, .Height = 2};
  configure(Scene, T);
  limit({0, 1, 2, 3, 5, 0, 1, 4}, T);
  ASSERT_EQ(start(), VR_OK);
  EXPECT_EQ(Agent.counters(), (Counters{1, 5, 0, 40, 16}));
  // Closed pixels take no slot.
  const Counters Before = Agent.counters();
  set(Csr::Options, OptionsSkipSaturated.put(1));
  ASSERT_EQ(start(), VR_OK);
  EXPECT_EQ(Agent.counters().Fragments - Before.Fragments, 16U);
  // Nothing is fetched where no pixel takes anything.
  limit(std::vector<uint32_t>(8, 0), T);
  ASSERT_EQ(start(), VR_OK);
  EXPECT_EQ(Agent.counters().Gaussians, 10U);
  EXPECT_EQ(pixels(4, 2), std::vector<Pixel>(8, Pixel{0, 0, 0, 1}));
}

TEST_F(LimitsTest, PushedAndDrained) {
  const TileCommand T{
      .Mode = ModePushed.put(1) | ModeDrain.put(1), .Width = 3, .Height = 1};
  configure({}, T);
  limit({0, 1, 2}, T);
  for (const auto &[C, Value] : {std::pair{Csr::GMeanX, 1.5F},
                                 {Csr::GMeanY, 0.5F},
                                 {Csr::GOpacity, 0.5F},
                                 {Csr::GExtentX, 9.0F},
                                 {Csr::GExtentY, 9.0F}})
    set(C, Value);
  set(Csr::Push, 1U);
  set(Csr::Push, 1U);
  set(Csr::Push, 1U);
  ASSERT_EQ(start(), VR_OK);
  EXPECT_EQ(Agent.counters().Gaussians, 2U);
  ASSERT_EQ(Agent.drainedTile().size(), 3U);
  EXPECT_EQ(Agent.drainedTile()[0].T, 1.0F);
  EXPECT_EQ(Agent.drainedTile()[1].T, 0.5F);
  EXPECT_EQ(Agent.drainedTile()[2].T, 0.25F);
}

TEST_F(LimitsTest, PixelsTakeTheirRanges) {
  const std::vector<Gaussian> Scene = scene(12);
  const TileCommand Tiles[] = {
      {.X = 9, .Y = 2, .Width = 23, .Height = 17},
      {.Cutoff = 0.3F,
       .Options = OptionsSkipSaturated.put(1) | OptionsBlend.put(1),
       .Width = 64,
       .Height = 32}};
  for (const TileCommand &T : Tiles) {
    const std::vector<uint32_t> To = someLimits(T, 14),
                                From = someLimits(T, 13);
    configure(Scene, T);
    limit(To, T);
    beginAt(From, T);
    ASSERT_EQ(start(), VR_OK);
    const std::vector<Pixel> Ranged = pixels(T.Width, T.Height);
    std::size_t Compared = 0;
    for (uint32_t First = 0; First <= Scene.size(); ++First)
      for (uint32_t End = First; End <= Scene.size(); ++End) {
        const std::vector<Pixel> Model =
            render(std::span(Scene).subspan(First, End - First), T);
        for (std::size_t P = 0; P != Ranged.size(); ++P) {
          const uint32_t Begins = std::min(From[P], 12U);
          if (Begins != First || std::max(std::min(To[P], 12U), Begins) != End)
            continue;
          ASSERT_EQ(Ranged[P], Model[P]) << P;
          ++Compared;
        }
      }
    EXPECT_EQ(Compared, Ranged.size());
  }
}

// A list in commands one after the other, cut elsewhere in each pixel, leaves
// the bits of one command: saturated pixels are kept.
TEST_F(LimitsTest, SequencesOfRangesAreOneCommand) {
  const std::vector<Gaussian> Scene = scene(60);
  const TileCommand Tiles[] = {
      {.Width = 64, .Height = 32},
      {.Cutoff = 0.3F, .X = 5, .Y = 1, .Width = 31, .Height = 64},
      {.Cutoff = 0.1F,
       .Options = OptionsStopAtEqual.put(1) | OptionsSkipSaturated.put(1) |
                  OptionsExp.put(VR_EXP_TABLE) | OptionsAlphaCutoff.put(2),
       .Width = 64,
       .Height = 32}};
  for (const TileCommand &T : Tiles) {
    const std::vector<Pixel> Whole = render(Scene, T);
    std::vector<uint32_t> First = someLimits(T, 50), Second = someLimits(T, 70);
    for (std::size_t P = 0; P != First.size(); ++P)
      Second[P] = std::max(First[P], Second[P]);
    configure(Scene, T);
    limit(First, T);
    addMode(ModeKeepSaturated.put(1));
    ASSERT_EQ(start(), VR_OK);
    limit(Second, T);
    beginAt(First, T);
    addMode(ModeLoad.put(1) | ModeKeepSaturated.put(1));
    ASSERT_EQ(start(), VR_OK);
    const std::vector<Pixel> Kept = pixels(T.Width, T.Height);
    set(Csr::Mode, T.Mode | ModeLoad.put(1));
    beginAt(Second, T);
    ASSERT_EQ(start(), VR_OK);
    EXPECT_EQ(pixels(T.Width, T.Height), Whole);
    // What was saturated before the last one took nothing of it.
    std::size_t Saturated = 0;
    for (std::size_t P = 0; P != Kept.size(); ++P)
      if (std::signbit(Kept[P].T)) {
        ++Saturated;
        EXPECT_EQ(Kept[P].T, -Whole[P].T);
        EXPECT_EQ(Kept[P].R, Whole[P].R);
      }
    if (T.Cutoff > 0.01F)
      EXPECT_GT(Saturated, 0U);
  }
}

TEST_F(LimitsTest, NothingIsFetchedBeforeTheFirst) {
  const std::vector<Gaussian> Scene(9, flatGaussian(8, 8, 100, 100, 0.25F));
  const TileCommand T{.Width = 4, .Height = 2};
  KeptWork Log;
  Unit.setLog(&Log);
  configure(Scene, T);
  limit({9, 9, 7, 3, 6, 0, 2, 4}, T);
  beginAt({9, 8, 3, 3, 4, 0, 6, ~0U}, T);
  ASSERT_EQ(start(), VR_OK);
  // From the third pixel's first to the second pixel's last.
  EXPECT_EQ(Agent.counters(), (Counters{1, 6, 0, 48, 1 + 4 + 2}));
  EXPECT_EQ(Log.Commands[0].First, 3U);
  EXPECT_EQ(pixels(4, 2)[5], (Pixel{0, 0, 0, 1}));
  // Nobody takes anything.
  beginAt(std::vector<uint32_t>(8, 9), T);
  ASSERT_EQ(start(), VR_OK);
  EXPECT_EQ(Agent.counters().Gaussians, 6U);
  Unit.setLog(nullptr);
}

TEST_F(LimitsTest, StatusCodes) {
  const std::vector<Gaussian> Scene = scene(3);
  struct Case {
    TileCommand Tile;
    uint32_t Address, TailCount, Status;
  };
  const uint32_t End = TestMemory::Base + (8 << 20);
  const Case Cases[] = {
      {{.Width = 64, .Height = 32}, Limits, 0, VR_OK},
      {{.Width = 64, .Height = 33}, Limits, 0, VR_BAD_SHAPE},
      {{.Width = 64, .Height = 32}, Limits + 2, 0, VR_MISALIGNED},
      {{.Width = 64, .Height = 32}, 0, 0, VR_UNMAPPED},
      {{.Width = 64, .Height = 32}, End - 31 * LimitPitch - 64 * 4, 0, VR_OK},
      {{.Width = 64, .Height = 32},
       End - 31 * LimitPitch - 63 * 4,
       0,
       VR_UNMAPPED},
      {{.Width = 64, .Height = 32}, Limits, 1, VR_OK},
      {{.Mode = ModeFrom.put(1), .Width = 64, .Height = 33},
       Limits,
       0,
       VR_BAD_SHAPE},
      {{.Mode = ModeFrom.put(1) | ModeKeepLast.put(1), .Width = 8, .Height = 8},
       Limits,
       0,
       VR_BAD_MODE},
      {{.Mode = ModeLoad.put(1) | ModeDrain.put(1), .Width = 8, .Height = 8},
       Limits,
       0,
       VR_BAD_MODE},
      {{.Mode = ModeBackward.put(1), .Width = 8, .Height = 8},
       Limits,
       0,
       VR_BAD_MODE},
      {{.Mode = ModePrimitive.put(VR_PRIMITIVE_TRIANGLE)},
       Limits,
       0,
       VR_BAD_MODE},
      {{.Mode = ModeKeepLast.put(1) | ModeDrain.put(1)},
       Limits,
       0,
       VR_BAD_MODE}};
  for (const Case &C : Cases) {
    configure(Scene, C.Tile);
    set(Csr::Last, Lasts);
    set(Csr::TailCount, C.TailCount);
    set(Csr::TailRecord, Records);
    set(Csr::Mode, C.Tile.Mode | ModeLimited.put(1));
    setWord(VR_WORD_LIMIT, C.Address);
    setWord(VR_WORD_LIMIT_FIRST, 0);
    EXPECT_EQ(start(), C.Status) << &C - Cases;
    set(Csr::TailCount, 0U);
  }
  // First entries, and what begins a sequence.
  const std::tuple<uint32_t, uint32_t, uint32_t, uint32_t> Others[] = {
      {ModeFrom.put(1), Limits, 0, VR_OK},
      {ModeFrom.put(1), Limits + 2, 0, VR_MISALIGNED},
      {ModeFrom.put(1), End, 0, VR_UNMAPPED},
      {ModeLoad.put(1) | ModeKeepSaturated.put(1), 0, 0, VR_OK},
      {ModeLoad.put(1), 0, 2, VR_BAD_MODE},
      {ModeKeepSaturated.put(1), 0, 2, VR_BAD_MODE},
      {ModeKeepSaturated.put(1) | ModeDrain.put(1), 0, 0, VR_BAD_MODE},
      {1U << 13, 0, 0, VR_BAD_MODE}};
  for (const auto &[Mode, Address, Parts, Status] : Others) {
    configure(Scene, {.Mode = Mode, .Width = 8, .Height = 8});
    setWord(VR_WORD_FROM, Address);
    set(Csr::Ztile, ZtileCount.put(Parts));
    EXPECT_EQ(start(), Status) << Mode << ' ' << Address;
  }
  // Draining needs rows of limits all the same.
  configure(Scene, {.Mode = ModeDrain.put(1), .Width = 8, .Height = 8});
  limit(std::vector<uint32_t>(64, 1),
        {.Mode = ModeDrain.put(1), .Width = 8, .Height = 8});
  set(Csr::OutputPitch, 40U);
  EXPECT_EQ(start(), VR_MISALIGNED);
}

} // namespace
} // namespace vorion::raster
