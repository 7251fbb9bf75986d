// Random scenes: bit for bit against a scalar fp32 loop on every vector level,
// and within tolerance against doubles.
#include "raster/Datapath.h"
#include "raster/RandomScene.h"
#include "raster/RasterTest.h"
#include "raster/ScalarUnits.h"

#include <cmath>

namespace vorion::raster {
namespace {

/// What vr_options may choose in a lane.
struct Lane {
  uint32_t Exp = VR_EXP_EXACT;
  uint32_t Blend = VR_BLEND_FP32;
  float MinAlpha = 1.0F / 255.0F;
};

struct Result {
  std::vector<Pixel> Pixels;
  Counters Work;
};

/// docs/abi.md read aloud, one pixel at a time; Gaussian-centric only in that
/// the tile ends early.
Result onePixelAtATime(const Scene &S, const Lane &L = {}) {
  Result Out;
  Out.Pixels.assign(std::size_t{S.Width} * S.Height, {0, 0, 0, 1});
  std::vector<bool> Saturated(Out.Pixels.size());
  std::size_t Live = Out.Pixels.size();
  for (const Gaussian &G : S.Gaussians) {
    if (Live == 0)
      break;
    ++Out.Work.Gaussians;
    uint64_t Fragments = 0;
    for (unsigned I = 0; I != Out.Pixels.size(); ++I) {
      const unsigned Row = I / S.Width;
      const float Px = static_cast<float>(S.X + I % S.Width) + 0.5F;
      const float Py = static_cast<float>(S.Y + Row) + 0.5F;
      if (!(std::fabs(Px - G.Mean[0]) <= G.Extent[0] &&
            std::fabs(Py - G.Mean[1]) <= G.Extent[1]))
        continue;
      ++Fragments;
      if (Saturated[I])
        continue;
      const float Dx = G.Mean[0] - Px;
      const float Dy = G.Mean[1] - Py;
      const float Power =
          -0.5F * (G.Conic[0] * Dx * Dx + G.Conic[2] * Dy * Dy) -
          G.Conic[1] * Dx * Dy;
      if (!(Power <= 0.0F))
        continue;
      const float Alpha =
          std::fmin(0.99F, G.Opacity * scalar::exp(L.Exp, Power));
      if (Alpha < L.MinAlpha)
        continue;
      Pixel &P = Out.Pixels[I];
      const auto Rounded = [&](float X) { return scalar::operand(L.Blend, X); };
      float Taken = Alpha * P.T;
      float NextT = P.T * (1.0F - Alpha);
      if (L.Blend != VR_BLEND_FP32) {
        Taken = Rounded(Alpha) * Rounded(P.T);
        NextT = P.T - Taken;
      }
      if (S.StopAtEqual ? NextT <= S.Cutoff : NextT < S.Cutoff) {
        Saturated[I] = true;
        --Live;
        continue;
      }
      P.R += Rounded(G.Color[0]) * Rounded(Taken);
      P.G += Rounded(G.Color[1]) * Rounded(Taken);
      P.B += Rounded(G.Color[2]) * Rounded(Taken);
      P.T = NextT;
      ++Out.Work.Blends;
    }
    Out.Work.Fragments += Fragments;
    Out.Work.Clipped += Fragments == 0;
  }
  return Out;
}

Result onLevel(const Datapath &Level, const Scene &S, const Lane &L = {}) {
  auto Tile = std::make_unique<TileBuffer>();
  Tile->reset(S.X, S.Y, S.Width, S.Height);
  const BlendOptions Options{S.StopAtEqual ? std::nextafter(S.Cutoff, 1.0F)
                                           : S.Cutoff,
                             L.MinAlpha, false};
  Result Out;
  for (const Gaussian &G : S.Gaussians) {
    if (Tile->Live == 0)
      break;
    const BoxWork Work = Level.Conics.Of[L.Exp][L.Blend](G, Options, *Tile);
    ++Out.Work.Gaussians;
    Out.Work.Clipped += Work.Clipped;
    Out.Work.Fragments += Work.Fragments;
    Out.Work.Blends += Work.Blends;
  }
  for (unsigned I = 0; I != S.Width * S.Height; ++I) {
    const unsigned At = I / S.Width * TileBuffer::Stride + I % S.Width;
    Out.Pixels.push_back(
        {Tile->R[At], Tile->G[At], Tile->B[At], std::fabs(Tile->T[At])});
  }
  return Out;
}

class EveryLevel : public testing::TestWithParam<const Datapath *> {};

INSTANTIATE_TEST_SUITE_P(Host, EveryLevel,
                         testing::ValuesIn(datapaths().begin(),
                                           datapaths().end()),
                         [](const auto &Info) { return Info.param->Name; });

TEST_P(EveryLevel, BitsOfTheScalarLoop) {
  Counters All;
  for (uint32_t Seed = 0; Seed != 60; ++Seed) {
    const Scene S = randomScene(Seed);
    const Result Right = onePixelAtATime(S);
    const Result Is = onLevel(*GetParam(), S);
    ASSERT_EQ(Is.Pixels, Right.Pixels) << Seed;
    ASSERT_EQ(Is.Work, Right.Work) << Seed;
    All += Is.Work;
  }
  // The scenes do reach every outcome.
  EXPECT_GT(All.Clipped, 100U);
  EXPECT_GT(All.Fragments, All.Blends);
  EXPECT_GT(All.Blends, 100000U);
}

TEST_P(EveryLevel, EveryLaneHasTheBitsOfTheScalarLoop) {
  uint32_t Seed = 0;
  for (uint32_t Exp = 0; Exp != ExpUnitCount; ++Exp)
    for (uint32_t Blend = 0; Blend != BlendUnitCount; ++Blend)
      for (const float Times : {1.0F, 8.0F}) {
        const Scene S = randomScene(Seed++ % 7 * 13);
        const Lane L{Exp, Blend, Times / 255.0F};
        const Result Right = onePixelAtATime(S, L);
        const Result Is = onLevel(*GetParam(), S, L);
        ASSERT_EQ(Is.Pixels, Right.Pixels) << Exp << ' ' << Blend;
        ASSERT_EQ(Is.Work, Right.Work) << Exp << ' ' << Blend;
      }
}

/// In doubles, and whether a pixel had a decision near its threshold, which
/// fp32 may take differently.
struct DoublePixel {
  double R = 0, G = 0, B = 0, T = 1;
  unsigned Blends = 0;
  bool Doubtful = false;
};

std::vector<DoublePixel> inDoubles(const Scene &S) {
  // fp32 rounding of the power's terms, relative to alpha.
  constexpr double Close = 1e-4;
  const auto Near = [](double Value, double Threshold) {
    return std::fabs(Value - Threshold) <= Close * Threshold;
  };
  std::vector<DoublePixel> Out(std::size_t{S.Width} * S.Height);
  for (unsigned I = 0; I != Out.size(); ++I) {
    DoublePixel &P = Out[I];
    const unsigned Row = I / S.Width;
    for (const Gaussian &G : S.Gaussians) {
      const double Dx = double{G.Mean[0]} - (S.X + I % S.Width + 0.5);
      const double Dy = double{G.Mean[1]} - (S.Y + Row + 0.5);
      P.Doubtful |= Near(std::fabs(Dx), double{G.Extent[0]}) ||
                    Near(std::fabs(Dy), double{G.Extent[1]});
      if (std::fabs(Dx) > double{G.Extent[0]} ||
          std::fabs(Dy) > double{G.Extent[1]})
        continue;
      const double Alpha = std::fmin(
          0.99, double{G.Opacity} * std::exp(-(double{G.Conic[0]} * Dx * Dx +
                                               double{G.Conic[2]} * Dy * Dy) /
                                                 2 -
                                             double{G.Conic[1]} * Dx * Dy));
      P.Doubtful |= Near(Alpha, 1.0 / 255);
      if (Alpha < 1.0 / 255)
        continue;
      const double NextT = P.T * (1 - Alpha);
      P.Doubtful |= Near(NextT, double{S.Cutoff});
      if (NextT < double{S.Cutoff})
        break;
      P.R += double{G.Color[0]} * Alpha * P.T;
      P.G += double{G.Color[1]} * Alpha * P.T;
      P.B += double{G.Color[2]} * Alpha * P.T;
      P.T = NextT;
      ++P.Blends;
    }
  }
  return Out;
}

class ScenesTest : public RasterTest {
protected:
  std::vector<Pixel> renderScene(const Scene &S, uint32_t Options = 0) {
    return render(S.Gaussians,
                  {.Cutoff = S.Cutoff,
                   .Options = Options | OptionsStopAtEqual.put(S.StopAtEqual),
                   .X = S.X,
                   .Y = S.Y,
                   .Width = S.Width,
                   .Height = S.Height});
  }
};

TEST_F(ScenesTest, CloseToDoublesOutsideDoubtfulPixels) {
  std::size_t Doubtful = 0;
  std::size_t All = 0;
  for (uint32_t Seed = 100; Seed != 140; ++Seed) {
    const Scene S = randomScene(Seed);
    const std::vector<Pixel> Is = renderScene(S);
    const std::vector<DoublePixel> Right = inDoubles(S);
    All += Right.size();
    for (std::size_t I = 0; I != Right.size(); ++I) {
      if (Right[I].Doubtful) {
        ++Doubtful;
        continue;
      }
      // A few hundred roundings of values up to 1, and the power's own.
      constexpr double Tolerance = 2e-5;
      ASSERT_NEAR(Is[I].R, Right[I].R, Tolerance) << Seed << ' ' << I;
      ASSERT_NEAR(Is[I].G, Right[I].G, Tolerance);
      ASSERT_NEAR(Is[I].B, Right[I].B, Tolerance);
      ASSERT_NEAR(Is[I].T, Right[I].T, Tolerance);
    }
  }
  EXPECT_LT(Doubtful, All / 20);
}

TEST_F(ScenesTest, BlendsAreThoseOfDoubles) {
  // One pixel a tile, so that the counter is the pixel's.
  std::size_t Compared = 0;
  for (uint32_t Seed = 200; Seed != 400; ++Seed) {
    Scene S = randomScene(Seed);
    S.X += S.Width / 2;
    S.Y += S.Height / 2;
    S.Width = S.Height = 1;
    const DoublePixel Right = inDoubles(S)[0];
    const uint64_t Before = Agent.counters().Blends;
    renderScene(S);
    if (Right.Doubtful)
      continue;
    ++Compared;
    ASSERT_EQ(Agent.counters().Blends - Before, Right.Blends) << Seed;
  }
  EXPECT_GT(Compared, 150U);
}

// Largest difference from the default lane outside doubtful pixels, over ten
// scenes of up to 400 layers. Without a cut-off: at one of a few percent a
// coarser lane may stop a Gaussian earlier, which any amount can hang on.
TEST_F(ScenesTest, CoarserLanesStayWithinTheirBounds) {
  struct Bound {
    uint32_t Options;
    double Least, Most;
  };
  const auto Exp = [](uint32_t Unit) { return OptionsExp.put(Unit); };
  const auto Blend = [](uint32_t Unit) { return OptionsBlend.put(Unit); };
  for (const Bound &B : {Bound{Exp(VR_EXP_TABLE), 1e-5, 1e-3},
                         {Exp(VR_EXP_POLY2), 1e-4, 6e-3},
                         {Exp(VR_EXP_POLY3), 1e-6, 3e-4},
                         {Exp(VR_EXP_POLY4), 1e-8, 2e-5},
                         {Exp(VR_EXP_TABLE32), 1e-6, 3e-4},
                         {Exp(VR_EXP_TABLE64), 1e-6, 1e-4},
                         {Blend(VR_BLEND_BF16), 1e-4, 1e-2},
                         {Blend(VR_BLEND_FP16), 1e-5, 2e-3},
                         {OptionsAlphaCutoff.put(1), 1e-4, 3e-2},
                         {OptionsAlphaCutoff.put(3), 1e-3, 0.2}}) {
    double Largest = 0;
    for (uint32_t Seed = 100; Seed != 110; ++Seed) {
      Scene S = randomScene(Seed);
      S.Cutoff = 0;
      const std::vector<Pixel> Exact = renderScene(S);
      const std::vector<Pixel> Coarse = renderScene(S, B.Options);
      const std::vector<DoublePixel> Right = inDoubles(S);
      for (std::size_t I = 0; I != Exact.size(); ++I)
        Largest = std::max(
            Largest, Right[I].Doubtful
                         ? 0.0
                         : std::fabs(double{Coarse[I].R} - double{Exact[I].R}));
    }
    EXPECT_GT(Largest, B.Least) << B.Options;
    EXPECT_LT(Largest, B.Most) << B.Options;
  }
}

TEST_F(ScenesTest, AnotherRasterizerGivesTheSameBits) {
  const Scene S = randomScene(7);
  const std::vector<Pixel> First = renderScene(S);
  const Counters Work = Agent.counters();
  // A tile buffer that has seen other tiles, another agent's turn between.
  renderScene(randomScene(8));
  const Counters Before = Agent.counters();
  EXPECT_EQ(renderScene(S), First);
  EXPECT_EQ(Agent.counters().Blends - Before.Blends, Work.Blends);
  EXPECT_EQ(Agent.counters().Fragments - Before.Fragments, Work.Fragments);
}

} // namespace
} // namespace vorion::raster
