// One command at a time: pixels of closed form, clipping, thresholds, the early
// end, status codes, order of service.
#include "raster/RasterTest.h"
#include "raster/UnitTables.h"

#include <cfenv>
#include <cmath>
#include <limits>

namespace vorion::raster {
namespace {

using RasterizerTest = RasterTest;

constexpr float Inf = std::numeric_limits<float>::infinity();
constexpr float NotANumber = std::numeric_limits<float>::quiet_NaN();

std::span<const Gaussian> only(const Gaussian &G) { return {&G, 1}; }

/// Of constant alpha \p Opacity over its box.
Gaussian flat(float X, float Y, float ExtentX, float ExtentY, float Opacity,
              float Red = 1) {
  return {{X, Y}, {0, 0, 0}, Opacity, {Red, 2, 3}, {ExtentX, ExtentY}, 0};
}

TEST_F(RasterizerTest, OneGaussianIsItsFormula) {
  const Gaussian G{{130.3F, 77.8F},    {0.02F, 0.008F, 0.03F}, 0.8F,
                   {0.9F, 0.4F, 0.1F}, {1000, 1000},           7};
  const TileCommand Tile{.X = 100, .Y = 50, .Width = 60, .Height = 50};
  const std::vector<Pixel> Out = render(only(G), Tile);
  uint64_t Blends = 0;
  for (unsigned Y = 0; Y != Tile.Height; ++Y)
    for (unsigned X = 0; X != Tile.Width; ++X) {
      const double Dx = 100.5 + X - double{G.Mean[0]};
      const double Dy = 50.5 + Y - double{G.Mean[1]};
      const double Alpha =
          double{G.Opacity} * std::exp(-(double{G.Conic[0]} * Dx * Dx +
                                         double{G.Conic[2]} * Dy * Dy) /
                                           2 -
                                       double{G.Conic[1]} * Dx * Dy);
      const bool Counts = Alpha >= 1.0 / 255;
      Blends += Counts;
      const Pixel &P = Out[Y * Tile.Width + X];
      for (const auto &[Is, Colour] :
           {std::pair{P.R, G.Color[0]}, {P.G, G.Color[1]}, {P.B, G.Color[2]}})
        EXPECT_NEAR(Is, Counts ? Alpha * double{Colour} : 0, 2e-6);
      EXPECT_NEAR(P.T, Counts ? 1 - Alpha : 1, 2e-6);
    }
  EXPECT_EQ(Agent.counters(), (Counters{1, 1, 0, 3000, Blends}));
}

TEST_F(RasterizerTest, TwoFlatGaussiansBlendFrontToBack) {
  const Gaussian Scene[] = {flat(8, 8, 100, 100, 0.5F, 1),
                            flat(8, 8, 100, 100, 0.25F, 4)};
  for (const Pixel &P : render(Scene, {.Width = 16, .Height = 16}))
    EXPECT_EQ(P, (Pixel{0.5F + 4 * 0.125F, 1.25F, 1.875F, 0.375F}));
}

TEST_F(RasterizerTest, AlphaIsClampedAt099) {
  const Gaussian G = flat(8, 8, 100, 100, 5.0F);
  const Pixel P = render(only(G))[0];
  EXPECT_EQ(P.R, 0.99F);
  EXPECT_EQ(P.T, 1.0F - 0.99F);
}

TEST_F(RasterizerTest, AlphaBelow1Of255IsSkipped) {
  const float Limit = 1.0F / 255.0F;
  for (const float Opacity : {Limit, std::nextafter(Limit, 0.0F)}) {
    const Gaussian G = flat(8, 8, 100, 100, Opacity);
    const bool Counts = Opacity >= Limit;
    EXPECT_EQ(render(only(G))[0].R, Counts ? Opacity : 0);
  }
  EXPECT_EQ(Agent.counters().Blends, 4096U);
}

TEST_F(RasterizerTest, OpacityThatNeverCounts) {
  for (const float Opacity : {0.0F, -0.0F, -1.0F, -Inf, 1e-30F}) {
    const Gaussian G = roundGaussian(32, 32, 4, Opacity);
    for (const Pixel &P : render(only(G)))
      EXPECT_EQ(P, (Pixel{0, 0, 0, 1}));
  }
  EXPECT_EQ(Agent.counters().Blends, 0U);
}

TEST_F(RasterizerTest, PowerAboveZeroOrNanIsSkipped) {
  Gaussian G = roundGaussian(32.5F, 32.5F, 4, 0.5F);
  G.Conic[0] = G.Conic[2] = -1; // power > 0 but at the centre
  const std::vector<Pixel> Out = render(only(G));
  EXPECT_EQ(Agent.counters().Blends, 1U);
  EXPECT_EQ(Out[32 * 64 + 32].T, 0.5F);

  Gaussian Undefined = flat(32, 32, 100, 100, 0.5F);
  Undefined.Conic[0] = Inf; // a dx dx + b dx dy with b = -inf: NaN
  Undefined.Conic[1] = -Inf;
  render(only(Undefined));
  EXPECT_EQ(Agent.counters().Blends, 1U);
}

TEST_F(RasterizerTest, InfiniteOpacity) {
  Gaussian G = flat(32, 32, 100, 100, Inf);
  EXPECT_EQ(render(only(G))[0].T, 1.0F - 0.99F);
  G.Conic[0] = 1e30F; // exp is 0, inf * 0 is NaN: skipped
  EXPECT_EQ(render(only(G))[0].T, 1.0F);
}

/// Fragments of a box are the pixels whose centres satisfy the rule of
/// docs/abi.md, judged one by one.
TEST_F(RasterizerTest, BoxClipping) {
  const float Means[] = {-1e30F, -70.0F, -3.2F, 0.0F,  0.5F, 31.7F, 63.5F,
                         64.0F,  65.25F, 150,   1e30F, -Inf, Inf};
  const float Extents[] = {-1.0F, 0.0F,  0.25F, 0.5F,  0.7F, 3.0F,
                           16.0F, 40.0F, 1e9F,  3e38F, Inf};
  const TileCommand Tile{.X = 3, .Y = 5, .Width = 61, .Height = 37};
  for (const float MeanX : Means)
    for (const float ExtentX : Extents) {
      const float MeanY = 20.25F;
      const float ExtentY = 7.3F;
      uint64_t Columns = 0;
      uint64_t Rows = 0;
      for (unsigned X = 0; X != Tile.Width; ++X)
        Columns +=
            std::fabs(static_cast<float>(Tile.X + X) + 0.5F - MeanX) <= ExtentX;
      for (unsigned Y = 0; Y != Tile.Height; ++Y)
        Rows +=
            std::fabs(static_cast<float>(Tile.Y + Y) + 0.5F - MeanY) <= ExtentY;
      for (const bool Turned : {false, true}) {
        const Gaussian G = Turned ? flat(MeanY, MeanX, ExtentY, ExtentX, 0.5F)
                                  : flat(MeanX, MeanY, ExtentX, ExtentY, 0.5F);
        TileCommand T = Tile;
        if (Turned) {
          std::swap(T.X, T.Y);
          std::swap(T.Width, T.Height);
        }
        const Counters Before = Agent.counters();
        render(only(G), T);
        EXPECT_EQ(Agent.counters().Fragments - Before.Fragments, Columns * Rows)
            << MeanX << ' ' << ExtentX << ' ' << Turned;
        EXPECT_EQ(Agent.counters().Clipped - Before.Clipped,
                  Columns * Rows == 0)
            << MeanX << ' ' << ExtentX << ' ' << Turned;
      }
    }
}

// Rows and columns have like centres, so that reading one for the other shows.
TEST_F(RasterizerTest, BoxesOfEveryWidthTouchTheirPixelsOnly) {
  for (unsigned Width = 1; Width <= 64; ++Width)
    for (unsigned First = 0; First + Width <= 64; First += 5) {
      const float Half = 0.5F * static_cast<float>(Width);
      const Gaussian G =
          flat(static_cast<float>(First) + Half, 54, Half - 0.5F, 0.5F, 0.5F);
      const std::vector<Pixel> Out = render(only(G), {.Y = 52, .Height = 4});
      for (unsigned I = 0; I != Out.size(); ++I) {
        const bool In = I / 64 >= 1 && I / 64 <= 2 && I % 64 >= First &&
                        I % 64 < First + Width;
        ASSERT_EQ(Out[I].T, In ? 0.5F : 1.0F) << Width << ' ' << First;
      }
    }
}

TEST_F(RasterizerTest, StopRulesAtTheExactCutoff) {
  // T goes 1, 1/2, 1/4; the cut-off is what the second would leave.
  const Gaussian Scene[] = {flat(8, 8, 9, 9, 0.5F), flat(8, 8, 9, 9, 0.5F)};
  const uint32_t AtEqual = OptionsStopAtEqual.put(1);
  const float Above = std::nextafter(0.25F, 1.0F);
  const float Below = std::nextafter(0.25F, 0.0F);
  const auto T = [&](float Cutoff, uint32_t Options) {
    return render(Scene, {.Cutoff = Cutoff, .Options = Options})[0].T;
  };
  EXPECT_EQ(T(0.25F, 0), 0.25F);
  EXPECT_EQ(T(Above, 0), 0.5F);
  EXPECT_EQ(T(Below, 0), 0.25F);
  EXPECT_EQ(T(0.25F, AtEqual), 0.5F);
  EXPECT_EQ(T(Above, AtEqual), 0.5F);
  EXPECT_EQ(T(Below, AtEqual), 0.25F);
}

TEST_F(RasterizerTest, CutoffZeroNeverStops) {
  const std::vector<Gaussian> Scene(40, flat(8, 8, 9, 9, 0.99F));
  const Pixel P = render(Scene, {.Cutoff = 0, .Width = 16, .Height = 16})[0];
  EXPECT_EQ(P.T, 0.0F);
  EXPECT_EQ(Agent.counters().Blends, 40U * 256);
  render(Scene, {.Cutoff = -0.0F, .Width = 16, .Height = 16});
  EXPECT_EQ(Agent.counters().Blends, 80U * 256);
}

TEST_F(RasterizerTest, SaturatedPixelTakesNoFainterGaussian) {
  // The second would leave T under the cut-off: it is not blended and closes
  // the pixel to the third, though that alone would fit.
  const Gaussian Scene[] = {flat(8, 8, 9, 9, 0.5F), flat(8, 8, 9, 9, 0.9F),
                            flat(8, 8, 9, 9, 0.1F)};
  const Pixel P = render(Scene, {.Cutoff = 0.1F})[0];
  EXPECT_EQ(P.R, 0.5F);
  EXPECT_EQ(P.T, 0.5F);
}

TEST_F(RasterizerTest, TileEndsWhenAllPixelsAreSaturated) {
  // 0.99 blends, the second saturates all; the third is never fetched.
  std::vector<Gaussian> Scene(5, flat(8, 8, 100, 100, 0.99F));
  Scene[4].Mean[0] = NotANumber;
  render(Scene, {.Cutoff = 0.005F, .Width = 20, .Height = 10});
  EXPECT_EQ(Agent.counters(), (Counters{1, 2, 0, 400, 200}));

  // One pixel left open: everything is fetched.
  Scene.assign(5, flat(9.5F, 5, 9.5F, 100, 0.99F));
  render(Scene, {.Cutoff = 0.005F, .Width = 20, .Height = 10});
  EXPECT_EQ(Agent.counters().Gaussians, 2U + 5U);
}

TEST_F(RasterizerTest, SkipSaturatedChangesFragmentsOnly) {
  std::vector<Gaussian> Scene;
  for (int I = 0; I != 60; ++I)
    Scene.push_back(roundGaussian(static_cast<float>(I % 7) * 9,
                                  static_cast<float>(I % 5) * 14, 12, 0.95F));
  const std::vector<Pixel> Plain = render(Scene);
  const Counters Issued = Agent.counters();
  const std::vector<Pixel> Skipping =
      render(Scene, {.Options = OptionsSkipSaturated.put(1)});
  EXPECT_EQ(Plain, Skipping);
  EXPECT_EQ(Agent.counters().Blends, 2 * Issued.Blends);
  EXPECT_EQ(Agent.counters().Gaussians, 2 * Issued.Gaussians);
  EXPECT_LT(Agent.counters().Fragments - Issued.Fragments, Issued.Fragments);

  // Counted by hand: 1 x 1, saturated by the second, the third skipped.
  const Counters Before = Agent.counters();
  Scene.assign(3, flat(0.5F, 0.5F, 0, 0, 0.99F));
  Scene.push_back(flat(1.5F, 0.5F, 0, 0, 0.5F));
  render(Scene, {.Cutoff = 0.005F,
                 .Options = OptionsSkipSaturated.put(1),
                 .Width = 2,
                 .Height = 1});
  EXPECT_EQ(Agent.counters().Fragments - Before.Fragments, 2U + 0U + 1U);
  EXPECT_EQ(Agent.counters().Clipped, Before.Clipped);
}

TEST_F(RasterizerTest, CountZeroIsAnEmptyTile) {
  Memory.put<float>(Pixels, std::vector<float>(64 * 64 * 4, 7.0F));
  configure({}, {.Width = 5, .Height = 3});
  set(Csr::List, 0U); // nothing is read there
  set(Csr::Gaussians, 0U);
  ASSERT_EQ(start(), VR_OK);
  for (unsigned Row = 0; Row != 4; ++Row)
    for (unsigned X = 0; X != 6; ++X)
      EXPECT_EQ(Memory.get<Pixel>(Pixels + Row * Pitch + 16 * X, 1)[0],
                Row < 3 && X < 5 ? (Pixel{0, 0, 0, 1}) : (Pixel{7, 7, 7, 7}));
  EXPECT_EQ(Agent.counters(), (Counters{1, 0, 0, 0, 0}));
}

TEST_F(RasterizerTest, StatusCodesOfTheBank) {
  struct Case {
    Csr Register;
    uint32_t Value;
    uint32_t Status;
  };
  const auto F = [](float X) { return std::bit_cast<uint32_t>(X); };
  const uint32_t End = TestMemory::Base + (8 << 20);
  const Case Cases[] = {
      {Csr::Mode, 32, VR_BAD_MODE},
      {Csr::Options, OptionsExp.put(ExpUnitCount), VR_BAD_MODE},
      {Csr::Options, OptionsExp.put(15), VR_BAD_MODE},
      {Csr::Options, OptionsBlend.put(BlendUnitCount), VR_BAD_MODE},
      {Csr::Options, 0x80000000, VR_BAD_MODE},
      {Csr::Ztile, 0x00010001, VR_BAD_MODE},
      {Csr::Ztile, 0x00000001, VR_BAD_MODE},
      {Csr::Ztile, 0x00040003, VR_OK},
      {Csr::TileShape, 0x00400000, VR_BAD_SHAPE},
      {Csr::TileShape, 0x00000040, VR_BAD_SHAPE},
      {Csr::TileShape, 0x00400041, VR_BAD_SHAPE},
      {Csr::TileShape, 0x00410040, VR_BAD_SHAPE},
      {Csr::TileShape, 0x00010001, VR_OK},
      {Csr::TileOrigin, 0xffffffff, VR_OK},
      {Csr::Cutoff, F(1.0F), VR_BAD_CUTOFF},
      {Csr::Cutoff, F(-1e-4F), VR_BAD_CUTOFF},
      {Csr::Cutoff, F(NotANumber), VR_BAD_CUTOFF},
      {Csr::Cutoff, F(Inf), VR_BAD_CUTOFF},
      {Csr::Cutoff, F(std::nextafter(1.0F, 0.0F)), VR_OK},
      {Csr::Count, VR_MAX_COUNT + 1, VR_BAD_COUNT},
      {Csr::Count, VR_MAX_COUNT, VR_UNMAPPED}, // beyond this memory
      {Csr::Gaussians, Records + 8, VR_MISALIGNED},
      {Csr::List, List + 2, VR_MISALIGNED},
      {Csr::Output, Pixels + 4, VR_MISALIGNED},
      {Csr::OutputPitch, Pitch + 8, VR_MISALIGNED},
      {Csr::Gaussians, 0, VR_UNMAPPED},
      {Csr::Gaussians, 0xffff0000, VR_UNMAPPED}, // local memory
      {Csr::Gaussians, End - 32, VR_UNMAPPED},
      {Csr::Gaussians, End - 48, VR_OK},
      {Csr::List, 0xfffffffc, VR_UNMAPPED},
      {Csr::List, End, VR_UNMAPPED},
      {Csr::Output, 0xffff0000, VR_UNMAPPED},
      {Csr::Output, End - 63 * Pitch - 64 * 16, VR_OK},
      {Csr::Output, End - 63 * Pitch - 63 * 16, VR_UNMAPPED},
      {Csr::OutputPitch, 0xfffffff0, VR_UNMAPPED}, // must not wrap around
      {Csr::OutputPitch, 0x80000000, VR_UNMAPPED},
  };
  for (const Case &Wrong : Cases) {
    const Gaussian G = flat(8, 8, 4, 4, 0.5F);
    configure(only(G));
    set(Wrong.Register, Wrong.Value);
    EXPECT_EQ(start(), Wrong.Status)
        << findCsr(static_cast<unsigned>(Wrong.Register))->Name << ' '
        << Wrong.Value;
  }
  EXPECT_EQ(Agent.counters().Commands, std::size(Cases));
}

/// With mode "keep_counts": a place for two words, and no place.
class CountsTest : public RasterTest {
protected:
  static constexpr uint32_t Counts = Pixels + 0x100000;
  static constexpr uint32_t Untouched = 0x55555555;
  using Words = std::vector<uint32_t>;

  /// The tile of \p Scene, whose command ends with \p Status; the words around
  /// and at Counts.
  Words countsOf(std::span<const Gaussian> Scene, uint32_t Mode,
                 uint32_t Status = VR_OK) {
    Memory.put<uint32_t>(Counts - 4, Words(4, Untouched));
    configure(Scene, {.Mode = Mode, .Width = 16, .Height = 16});
    set(Csr::Last, Counts);
    EXPECT_EQ(start(), Status);
    return Memory.get<uint32_t>(Counts - 4, 4);
  }
};

TEST_F(CountsTest, ARenderStoresItsGaussiansAndFragments) {
  const Gaussian Scene[] = {flat(8, 8, 2, 2, 0.5F), flat(8, 8, 4, 4, 0.5F),
                            flat(100, 8, 4, 4, 0.5F)};
  EXPECT_EQ(countsOf(Scene, ModeKeepCounts.put(1)),
            (Words{Untouched, 3, 16 + 64, Untouched}));
  EXPECT_EQ(countsOf({}, ModeKeepCounts.put(1)),
            (Words{Untouched, 0, 0, Untouched}));
  EXPECT_EQ(countsOf(Scene, 0), Words(4, Untouched)) << "not asked for";
}

TEST_F(CountsTest, WhatAClosedTileLeavesOutDoesNotCount) {
  const std::vector<Gaussian> Scene(9, flat(8, 8, 100, 100, 0.99F));
  EXPECT_EQ(countsOf(Scene, ModeKeepCounts.put(1)),
            (Words{Untouched, 2, 2 * 256, Untouched}));
}

TEST_F(CountsTest, TheyAreOfThisCommandAlone) {
  const Gaussian G = flat(8, 8, 2, 2, 0.5F);
  EXPECT_EQ(countsOf(only(G), ModeKeepCounts.put(1)),
            countsOf(only(G), ModeKeepCounts.put(1)));
}

TEST_F(CountsTest, ACommandThatFailsStoresNone) {
  const Gaussian G = flat(NotANumber, 8, 2, 2, 0.5F);
  EXPECT_EQ(countsOf(only(G), ModeKeepCounts.put(1), VR_NAN),
            Words(4, Untouched));
}

TEST_F(CountsTest, ItsModeAndAddressAreChecked) {
  const Gaussian G = flat(8, 8, 2, 2, 0.5F);
  for (const uint32_t Other : {ModeKeepLast.put(1), ModeBackward.put(1)})
    countsOf(only(G), ModeKeepCounts.put(1) | Other, VR_BAD_MODE);
  configure(only(G), {.Mode = ModeKeepCounts.put(1)});
  const uint32_t End = TestMemory::Base + (8 << 20);
  for (const auto &[Address, Status] : {std::pair{Counts + 4, VR_MISALIGNED},
                                        {End, VR_UNMAPPED},
                                        {0xffff0000U, VR_UNMAPPED},
                                        {End - 8, VR_OK}}) {
    set(Csr::Last, Address);
    EXPECT_EQ(start(), Status) << Address;
  }
}

TEST_F(RasterizerTest, FirstCheckDecides) {
  // Everything is wrong; repaired in the documented order.
  configure({});
  set(Csr::Mode, 32U);
  set(Csr::TileShape, 0U);
  set(Csr::Cutoff, 1.0F);
  set(Csr::Count, 0xffffffffU);
  set(Csr::List, 0xffff0001U);
  EXPECT_EQ(start(), VR_BAD_MODE);
  set(Csr::Mode, 0U);
  EXPECT_EQ(start(), VR_BAD_SHAPE);
  set(Csr::TileShape, 0x400040U);
  EXPECT_EQ(start(), VR_BAD_CUTOFF);
  set(Csr::Cutoff, 0.0F);
  EXPECT_EQ(start(), VR_BAD_COUNT);
  set(Csr::Count, 1U);
  EXPECT_EQ(start(), VR_MISALIGNED);
  set(Csr::List, 0xffff0000U);
  EXPECT_EQ(start(), VR_UNMAPPED);
}

TEST_F(RasterizerTest, ListEntryOutOfRangeIsUnmapped) {
  for (const uint32_t Number : {0xffffffffU, 0x05555556U, 200000U}) {
    const Gaussian Scene[] = {flat(8, 8, 4, 4, 0.5F), flat(8, 8, 4, 4, 0.5F)};
    configure(Scene);
    Memory.put<uint32_t>(List + 4, std::span(&Number, 1));
    EXPECT_EQ(start(), VR_UNMAPPED) << Number;
  }
}

TEST_F(RasterizerTest, IntersectTagIsCountedAndNoNumber) {
  const Gaussian Scene[] = {flat(8, 8, 100, 100, 0.5F, 1),
                            flat(8, 8, 100, 100, 0.25F, 4)};
  const std::vector<Pixel> Plain = render(Scene);
  EXPECT_EQ(Agent.counters().Intersecting, 0U);
  for (const uint32_t Tagged : {1U, 2U, 3U}) {
    const Counters Before = Agent.counters();
    configure(Scene);
    const uint32_t Entries[] = {Tagged & 1 ? VR_INTERSECT : 0U,
                                Tagged & 2 ? VR_INTERSECT | 1U : 1U};
    Memory.put<uint32_t>(List, Entries);
    ASSERT_EQ(start(), VR_OK);
    EXPECT_EQ(pixels(), Plain);
    EXPECT_EQ(Agent.counters().Intersecting - Before.Intersecting,
              uint64_t(std::popcount(Tagged)));
    EXPECT_EQ(Agent.counters().Blends, Before.Blends + 2 * 64 * 64);
  }
  // The number's limits are those of an entry without the bit: the last record
  // of memory, and the next.
  const uint32_t Last = TestMemory::Base + (8 << 20) - sizeof(Gaussian);
  configure(Scene);
  Memory.put<Gaussian>(Last - 48 * 7, Scene);
  set(Csr::Gaussians, Last - 48 * 7);
  for (const uint32_t Number : {0U, 1U}) {
    Memory.put<uint32_t>(List,
                         std::vector<uint32_t>{VR_INTERSECT | Number, Number});
    EXPECT_EQ(start(), VR_OK);
  }
  Memory.put<uint32_t>(List, std::vector<uint32_t>{VR_INTERSECT | 8U, 0U});
  EXPECT_EQ(start(), VR_UNMAPPED);
}

// In a pushed descriptor the tag is the record's.
TEST_F(RasterizerTest, IntersectTagOfAPushedDescriptor) {
  configure({}, {.Mode = ModePushed.put(1)});
  set(Csr::GTag, VR_INTERSECT | 5U);
  set(Csr::Push, 1U);
  set(Csr::GTag, 5U);
  set(Csr::Push, 1U);
  ASSERT_EQ(start(), VR_OK);
  EXPECT_EQ(Agent.counters().Gaussians, 2U);
  EXPECT_EQ(Agent.counters().Intersecting, 1U);
}

TEST_F(RasterizerTest, NanAnywhereInADescriptor) {
  for (unsigned Word = 0; Word != 12; ++Word) {
    Memory.put<float>(Pixels, std::vector<float>(64 * 64 * 4, 7.0F));
    Gaussian Scene[] = {flat(8, 8, 4, 4, 0.5F), flat(8, 8, 4, 4, 0.5F)};
    std::memcpy(reinterpret_cast<char *>(&Scene[1]) + 4 * Word, &NotANumber, 4);
    configure(Scene);
    // The tag is no float.
    EXPECT_EQ(start(), Word == 11 ? VR_OK : VR_NAN) << Word;
    // A failed command writes no pixel.
    if (Word != 11) {
      EXPECT_EQ(pixels()[0].R, 7.0F);
    }
  }
}

TEST_F(RasterizerTest, InfinityIsNotANan) {
  const Gaussian G{{Inf, 3}, {1, 0, 1}, 0.5F, {1, 1, 1}, {Inf, Inf}, 0};
  render(only(G));
  EXPECT_EQ(Agent.counters().Fragments, 4096U);
  EXPECT_EQ(Agent.counters().Blends, 0U);
}

TEST_F(RasterizerTest, AgentsAreServedInTurn) {
  // Each agent's commands write its number to the same pixel; what is left
  // after each step tells whose turn it was.
  std::vector<RasterAgent> Agents(4);
  Rasterizer Serving(Memory, {&Agents[0], &Agents[1], &Agents[2], &Agents[3]});
  std::vector<Gaussian> Scene;
  for (int I = 0; I != 4; ++I)
    Scene.push_back(flat(0.5F, 0.5F, 0, 0, 0.5F, static_cast<float>(2 * I)));
  Memory.put<Gaussian>(Records, Scene);
  const auto Queue = [&](uint32_t Number) {
    Memory.put<uint32_t>(List + 4 * Number, std::span(&Number, 1));
    const std::pair<Csr, uint32_t> Bank[] = {
        {Csr::Gaussians, Records}, {Csr::List, List + 4 * Number},
        {Csr::Count, 1},           {Csr::TileShape, 0x10001},
        {Csr::Output, Pixels},     {Csr::Start, 0}};
    for (const auto &[C, Value] : Bank)
      Agents[Number].write(C, std::span(&Value, 1), 1);
  };
  for (const uint32_t Number : {2U, 0U, 2U, 3U, 0U, 2U})
    Queue(Number);
  std::vector<float> Served;
  while (Serving.step())
    Served.push_back(Memory.get<float>(Pixels, 1)[0]);
  EXPECT_EQ(Served, (std::vector<float>{0, 2, 3, 0, 2, 2}));

  // The turn goes on after the last one served.
  for (const uint32_t Number : {0U, 1U, 2U, 3U})
    Queue(Number);
  Serving.finish(Agents[0]);
  EXPECT_FALSE(Agents[3].isBusy());
  EXPECT_FALSE(Agents[0].isBusy());
  EXPECT_TRUE(Agents[1].isBusy());
}

TEST_F(RasterizerTest, FloatEnvironmentOfTheCallerDoesNotMatter) {
  std::vector<Gaussian> Scene;
  for (int I = 0; I != 20; ++I)
    Scene.push_back(
        roundGaussian(30.1F + static_cast<float>(I), 30.7F, 9, 0.3F));
  const std::vector<Pixel> Right = render(Scene);
  configure(Scene);
  std::fesetround(FE_UPWARD);
  std::feclearexcept(FE_ALL_EXCEPT);
  const uint32_t Status = start();
  const int Raised = std::fetestexcept(FE_ALL_EXCEPT);
  const int Rounding = std::fegetround();
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(Status, VR_OK);
  EXPECT_EQ(Raised, 0);
  EXPECT_EQ(Rounding, FE_UPWARD);
  EXPECT_EQ(pixels(), Right);
}

} // namespace
} // namespace vorion::raster
