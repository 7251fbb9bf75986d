// One command at a time: pixels of closed form, clipping, thresholds, the early
// end, order of service.
#include "raster/RasterTest.h"

#include <cfenv>
#include <cmath>

namespace vorion::raster {
namespace {

using RasterizerTest = RasterTest;

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
  const Gaussian Scene[] = {flatGaussian(8, 8, 100, 100, 0.5F, 1),
                            flatGaussian(8, 8, 100, 100, 0.25F, 4)};
  for (const Pixel &P : render(Scene, {.Width = 16, .Height = 16}))
    EXPECT_EQ(P, (Pixel{0.5F + 4 * 0.125F, 1.25F, 1.875F, 0.375F}));
}

TEST_F(RasterizerTest, AlphaIsClampedAt099) {
  const Gaussian G = flatGaussian(8, 8, 100, 100, 5.0F);
  const Pixel P = render(only(G))[0];
  EXPECT_EQ(P.R, 0.99F);
  EXPECT_EQ(P.T, 1.0F - 0.99F);
}

TEST_F(RasterizerTest, AlphaBelow1Of255IsSkipped) {
  const float Limit = 1.0F / 255.0F;
  for (const float Opacity : {Limit, std::nextafter(Limit, 0.0F)}) {
    const Gaussian G = flatGaussian(8, 8, 100, 100, Opacity);
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

  Gaussian Undefined = flatGaussian(32, 32, 100, 100, 0.5F);
  Undefined.Conic[0] = Inf; // a dx dx + b dx dy with b = -inf: NaN
  Undefined.Conic[1] = -Inf;
  render(only(Undefined));
  EXPECT_EQ(Agent.counters().Blends, 1U);
}

TEST_F(RasterizerTest, InfiniteOpacity) {
  Gaussian G = flatGaussian(32, 32, 100, 100, Inf);
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
        const Gaussian G =
            Turned ? flatGaussian(MeanY, MeanX, ExtentY, ExtentX, 0.5F)
                   : flatGaussian(MeanX, MeanY, ExtentX, ExtentY, 0.5F);
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
      const Gaussian G = flatGaussian(static_cast<float>(First) + Half, 54,
                                      Half - 0.5F, 0.5F, 0.5F);
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
  const Gaussian Scene[] = {flatGaussian(8, 8, 9, 9, 0.5F),
                            flatGaussian(8, 8, 9, 9, 0.5F)};
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
  const std::vector<Gaussian> Scene(40, flatGaussian(8, 8, 9, 9, 0.99F));
  const Pixel P = render(Scene, {.Cutoff = 0, .Width = 16, .Height = 16})[0];
  EXPECT_EQ(P.T, 0.0F);
  EXPECT_EQ(Agent.counters().Blends, 40U * 256);
  render(Scene, {.Cutoff = -0.0F, .Width = 16, .Height = 16});
  EXPECT_EQ(Agent.counters().Blends, 80U * 256);
}

TEST_F(RasterizerTest, SaturatedPixelTakesNoFainterGaussian) {
  // The second would leave T under the cut-off: it is not blended and closes
  // the pixel to the third, though that alone would fit.
  const Gaussian Scene[] = {flatGaussian(8, 8, 9, 9, 0.5F),
                            flatGaussian(8, 8, 9, 9, 0.9F),
                            flatGaussian(8, 8, 9, 9, 0.1F)};
  const Pixel P = render(Scene, {.Cutoff = 0.1F})[0];
  EXPECT_EQ(P.R, 0.5F);
  EXPECT_EQ(P.T, 0.5F);
}

TEST_F(RasterizerTest, TileEndsWhenAllPixelsAreSaturated) {
  // 0.99 blends, the second saturates all; the third is never fetched.
  std::vector<Gaussian> Scene(5, flatGaussian(8, 8, 100, 100, 0.99F));
  Scene[4].Mean[0] = NotANumber;
  render(Scene, {.Cutoff = 0.005F, .Width = 20, .Height = 10});
  EXPECT_EQ(Agent.counters(), (Counters{1, 2, 0, 400, 200}));

  // One pixel left open: everything is fetched.
  Scene.assign(5, flatGaussian(9.5F, 5, 9.5F, 100, 0.99F));
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
  Scene.assign(3, flatGaussian(0.5F, 0.5F, 0, 0, 0.99F));
  Scene.push_back(flatGaussian(1.5F, 0.5F, 0, 0, 0.5F));
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

TEST_F(RasterizerTest, IntersectTagIsCountedAndNoNumber) {
  const Gaussian Scene[] = {flatGaussian(8, 8, 100, 100, 0.5F, 1),
                            flatGaussian(8, 8, 100, 100, 0.25F, 4)};
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

TEST_F(RasterizerTest, AgentsAreServedInTurn) {
  // Each agent's commands write its number to the same pixel; what is left
  // after each step tells whose turn it was.
  std::vector<RasterAgent> Agents(4);
  Rasterizer Serving(Memory, {&Agents[0], &Agents[1], &Agents[2], &Agents[3]});
  std::vector<Gaussian> Scene;
  for (int I = 0; I != 4; ++I)
    Scene.push_back(
        flatGaussian(0.5F, 0.5F, 0, 0, 0.5F, static_cast<float>(2 * I)));
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

TEST_F(RasterizerTest, ALongListIsGoneThroughInStretches) {
  // One record 20,000 times, of which none closes a pixel.
  constexpr uint32_t Count = 20000;
  configure(only(flatGaussian(8, 8, 100, 100, 1.0F / 128)),
            {.Cutoff = 0, .Width = 1, .Height = 1});
  Memory.put(List, std::span<const uint32_t>(std::vector<uint32_t>(Count)));
  set(Csr::Count, Count);
  ASSERT_EQ(start(), VR_OK);
  const std::vector<Pixel> Alone = pixels(1, 1);
  KeptWork Log;
  Unit.setLog(&Log);
  set(Csr::Start, 1U);
  unsigned Steps = 0;
  for (; Unit.step(); ++Steps)
    EXPECT_LE(Log.Fetched, (Steps + 1) * 4096U);
  EXPECT_EQ(Steps, 5U);
  EXPECT_EQ(Log.Parts, 4U);
  EXPECT_EQ(Log.Fetched, Count);
  ASSERT_EQ(Log.Commands.size(), 1U);
  EXPECT_EQ(Log.Commands[0].Counts.Gaussians, Count);
  EXPECT_EQ(pixels(1, 1), Alone);
  Unit.setLog(nullptr);
}

} // namespace
} // namespace vorion::raster
