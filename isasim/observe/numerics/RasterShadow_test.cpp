#include "observe/numerics/RasterShadow.h"

#include "pixel/PixelUnit.h"
#include "raster/CommandInput.h"
#include "raster/RasterTest.h"

#include <random>

namespace vorion::raster {
namespace {

using namespace vorion::isasim;

/// 60 Gaussians of all sizes around a tile; some saturate it.
std::vector<Gaussian> scene(float X = 0, float Y = 0) {
  std::mt19937 Random(11);
  const auto Uniform = [&](float Low, float High) {
    return Low + (High - Low) * static_cast<float>(Random() / 0x1p32);
  };
  std::vector<Gaussian> All;
  for (unsigned N = 0; N != 60; ++N) {
    Gaussian G =
        roundGaussian(X + Uniform(-5, 69), Y + Uniform(-5, 69), Uniform(1, 12),
                      Uniform(0.02F, 1), Uniform(0, 1), Uniform(0, 1));
    G.Conic[1] = 0.3F * G.Conic[0];
    G.Tag = N;
    All.push_back(G);
  }
  return All;
}

/// Shows what units do to an observer.
struct Teller : WorkLog {
  explicit Teller(Observer &Shown) : To(Shown) {}
  void command(CommandWork &&Work) override { To.rasterCommand(Work); }
  void tail(TailWork &&Work) override { To.tail(Work); }
  Observer &To;
};

class RasterShadowTest : public RasterTest {
protected:
  NumericSites Sites;
  ShadowMemory Shadows;

  void SetUp() override { Shadows.begin(1); }

  /// The present bank, executed and then shown to \p To.
  void execute(RasterShadow &To) {
    To.useMemory(Memory);
    Teller Shown(To);
    Unit.setLog(&Shown);
    set(Csr::Start, 1U);
    Unit.finish(Agent);
    Unit.setLog(nullptr);
  }
  RasterFindings render(std::span<const Gaussian> Scene,
                        const TileCommand &T = {},
                        const Datapath &Lanes = *datapaths().back()) {
    configure(Scene, T);
    RasterShadow Shadow(Sites, Shadows, Lanes);
    execute(Shadow);
    return Shadow.findings();
  }
  static const StageCounts &at(const RasterFindings &F, RasterStage S) {
    return F.Stages[static_cast<size_t>(S)];
  }
  static uint64_t decisions(const RasterFindings &F) {
    uint64_t Sum = 0;
    for (const StageCounts &S : F.Stages)
      Sum += S.Differ;
    return Sum;
  }
};

/// A unit whose exponential is 1 % large below -1.
void brokenExp(float *Values, std::size_t Count) {
  std::vector<float> Powers(Values, Values + Count);
  datapaths().back()->Exp[VR_EXP_EXACT](Values, Count);
  for (std::size_t N = 0; N != Count; ++N)
    if (Powers[N] < -1)
      Values[N] *= 1.01F;
}

/// A unit that loses a thousandth of what gets through.
BoxWork brokenTransmittance(const Gaussian &G, const BlendOptions &Options,
                            TileBuffer &Tile) {
  std::vector<float> Before(Tile.T, Tile.T + TileBuffer::Pixels);
  const BoxWork W = datapaths().back()->Conics.Of[VR_EXP_EXACT][VR_BLEND_FP32](
      G, Options, Tile);
  for (unsigned N = 0; N != TileBuffer::Pixels; ++N)
    if (Tile.T[N] != Before[N])
      Tile.T[N] *= 0.999F;
  return W;
}

} // namespace

TEST_F(RasterShadowTest, RepeatsTheUnitBitForBitAndFindsOnlyRounding) {
  const RasterFindings F = render(scene(640, 320), {.X = 640, .Y = 320});
  EXPECT_EQ(F.Commands, 1U);
  EXPECT_EQ(F.Pixels, 4096U);
  EXPECT_EQ(F.NotReplayed, 0U);
  EXPECT_EQ(decisions(F), 0U);
  for (const StageCounts &S : F.Stages) {
    EXPECT_GT(S.Results, 10000U);
    EXPECT_LT(S.OwnMax, 1e-5) << (&S - F.Stages.data());
    EXPECT_LE(S.OwnSum, S.OwnMax * static_cast<double>(S.Results));
    EXPECT_EQ(S.NotFinite, 0U);
  }
  EXPECT_GT(at(F, RasterStage::Exp).OwnMax, 1e-9);
  EXPECT_LT(F.WorstPixels.at(0).Off, 1e-5);
  EXPECT_GE(F.WorstPixels.at(0).Off, F.WorstPixels.at(1).Off);
}

TEST_F(RasterShadowTest, WrittenPixelsHaveShadows) {
  const RasterFindings F = render(scene());
  const Pixel P = pixels()[64 * 20 + 30];
  const auto *Red = Shadows.find(0, Pixels + 20 * Pitch + 30 * 16,
                                 std::bit_cast<uint32_t>(P.R));
  ASSERT_NE(Red, nullptr);
  EXPECT_NEAR(Red->Value, P.R, 1e-6);
  EXPECT_NE(Red->Value, P.R);
  EXPECT_EQ(Sites.place(Origin::fromWord(Red->From).number()),
            "the rasterizer");
}

TEST_F(RasterShadowTest, ACoarseExponentialShowsInItsStageAlone) {
  for (const ExpUnit &Unit : ExpUnits) {
    SCOPED_TRACE(Unit.Name);
    const RasterFindings F =
        render(scene(), {.Options = OptionsExp.put(Unit.Option)});
    EXPECT_EQ(F.NotReplayed, 0U);
    EXPECT_LE(at(F, RasterStage::Exp).OwnMax, 1.01 * Unit.MaxRelativeError);
    EXPECT_GT(at(F, RasterStage::Exp).OwnMax, 0.3 * Unit.MaxRelativeError);
    for (const RasterStage S :
         {RasterStage::Offset, RasterStage::Power, RasterStage::Alpha,
          RasterStage::Transmittance, RasterStage::Colour}) {
      EXPECT_LT(at(F, S).OwnMax, 1e-5) << static_cast<int>(S);
    }
    // What comes after inherits it.
    if (Unit.MaxRelativeError > 1e-4)
      EXPECT_GT(at(F, RasterStage::Alpha).TotalMax,
                0.3 * Unit.MaxRelativeError);
  }
}

TEST_F(RasterShadowTest, SixteenBitsShowInTheBlendStages) {
  const RasterFindings F =
      render(scene(), {.Options = OptionsBlend.put(VR_BLEND_BF16)});
  EXPECT_EQ(F.NotReplayed, 0U);
  EXPECT_LT(at(F, RasterStage::Exp).OwnMax, 1e-7);
  EXPECT_LT(at(F, RasterStage::Alpha).OwnMax, 1e-7);
  EXPECT_GT(at(F, RasterStage::Transmittance).OwnMax, 1e-3);
  EXPECT_GT(at(F, RasterStage::Colour).OwnMax, 1e-3);
}

TEST_F(RasterShadowTest, AHigherCutoffIsTheShadowsToo) {
  const RasterFindings F =
      render(scene(), {.Options = OptionsAlphaCutoff.put(3)});
  EXPECT_EQ(F.NotReplayed, 0U);
  EXPECT_EQ(decisions(F), 0U);
}

TEST_F(RasterShadowTest, ABrokenExponentialIsPinned) {
  Datapath Broken = *datapaths().back();
  Broken.Exp[VR_EXP_EXACT] = brokenExp;
  const RasterFindings F = render(scene(), {}, Broken);
  EXPECT_NEAR(at(F, RasterStage::Exp).OwnMax, 0.01, 1e-5);
  EXPECT_LT(at(F, RasterStage::Power).OwnMax, 1e-5);
}

TEST_F(RasterShadowTest, ABrokenTransmittanceIsPinnedAndNoReplay) {
  Datapath Broken = *datapaths().back();
  Broken.Conics.Of[VR_EXP_EXACT][VR_BLEND_FP32] = brokenTransmittance;
  const RasterFindings F = render(scene(), {}, Broken);
  EXPECT_NEAR(at(F, RasterStage::Transmittance).OwnMax, 0.001, 1e-5);
  for (const RasterStage S :
       {RasterStage::Exp, RasterStage::Alpha, RasterStage::Colour}) {
    EXPECT_LT(at(F, S).OwnMax, 1e-5) << static_cast<int>(S);
  }
  EXPECT_GT(F.NotReplayed, 100U) << "the unit was another one";
}

TEST_F(RasterShadowTest, ErrorsOfRecordsComeFromTheirGaussian) {
  std::vector<Gaussian> Scene = scene();
  configure(Scene);
  // Record 7 should be 1 % more opaque, and its box half as wide.
  const uint32_t Record = Records + 7 * sizeof(Gaussian);
  const auto Shadow = [&](std::size_t Offset, float Is, double Should) {
    Shadows.set(0, Record + static_cast<uint32_t>(Offset),
                {Should, std::bit_cast<uint32_t>(Is), Origin::site(1).word()});
  };
  Shadow(offsetof(Gaussian, Opacity), Scene[7].Opacity,
         1.01 * Scene[7].Opacity);
  Shadow(offsetof(Gaussian, Extent), Scene[7].Extent[0],
         0.5 * Scene[7].Extent[0]);
  RasterShadow S(Sites, Shadows);
  execute(S);
  const RasterFindings &F = S.findings();
  EXPECT_EQ(F.NotReplayed, 0U);
  EXPECT_NEAR(at(F, RasterStage::Alpha).TotalMax, 0.01 / 1.01, 1e-4);
  EXPECT_LT(at(F, RasterStage::Alpha).OwnMax, 1e-6);
  EXPECT_GT(at(F, RasterStage::Offset).Differ, 0U);
  for (const auto &[Number, Counts] : F.Gaussians)
    if (Number == 7)
      EXPECT_GT(Counts.AlphaMax, 0.009);
    else
      EXPECT_LT(Counts.AlphaMax, 1e-5) << Number;
}

TEST_F(RasterShadowTest, AStopThatDiffersIsCounted) {
  // Two that leave just the cut-off in fp32, and less in the shadow.
  std::vector<Gaussian> Scene(2, roundGaussian(32, 32, 50, 0.5F));
  for (Gaussian &G : Scene)
    G.Conic[0] = G.Conic[2] = 0;
  configure(Scene, {.Cutoff = 0.25F, .Width = 4, .Height = 1});
  const auto Opacity =
      static_cast<uint32_t>(Records + offsetof(Gaussian, Opacity));
  Shadows.set(0, Opacity,
              {0.5001, std::bit_cast<uint32_t>(0.5F), Origin::site(1).word()});
  RasterShadow S(Sites, Shadows);
  execute(S);
  EXPECT_EQ(at(S.findings(), RasterStage::Transmittance).Differ, 4U);
}

TEST_F(RasterShadowTest, FollowsPushedAndRefusedCommands) {
  const std::vector<Gaussian> Scene = scene();
  configure({}, {.Mode = ModePushed.put(1)});
  for (const Gaussian &G : std::span(Scene).first(5)) {
    uint32_t Words[12];
    std::memcpy(Words, &G, sizeof(Words));
    for (unsigned N = 0; N != 12; ++N)
      set(static_cast<Csr>(static_cast<unsigned>(Csr::GMeanX) + N), Words[N]);
    set(Csr::Push, 0U);
  }
  RasterShadow S(Sites, Shadows);
  execute(S);
  EXPECT_EQ(S.findings().Commands, 1U);
  EXPECT_EQ(S.findings().NotReplayed, 0U);
  EXPECT_EQ(S.findings().Gaussians.size(), 5U);

  std::vector<Gaussian> Bad = scene();
  Bad[3].Opacity = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(render(Bad).Commands, 0U);
  EXPECT_EQ(render(scene(), {.Cutoff = 2}).Commands, 0U);
}

TEST_F(RasterShadowTest, LeavesTheWayBackAlone) {
  const std::vector<Gaussian> Scene = scene();
  configure(std::span(Scene).first(10), {.Height = 32});
  set(Csr::Mode, ModeBackward.put(1));
  set(Csr::Upstream, Pixels + 0x80000);
  set(Csr::Last, Pixels + 0xC0000);
  Memory.put<uint32_t>(Pixels + 0xC0000, std::vector<uint32_t>(64, 10));
  RasterShadow S(Sites, Shadows);
  execute(S);
  EXPECT_EQ(S.findings().Commands, 0U);
  EXPECT_EQ(Agent.counters().Commands, 1U);
  EXPECT_EQ(Agent.counters().Gaussians, 10U);
  EXPECT_EQ(Agent.read(Csr::Wait, 0), VR_OK);
}

TEST_F(RasterShadowTest, GoesOnWhereThePixelUnitDoes) {
  configure(scene());
  constexpr uint32_t Record = List + 0x100000;
  set(Csr::TailCount, 25U);
  set(Csr::TailRecord, Record);
  RasterShadow S(Sites, Shadows);
  execute(S);
  EXPECT_EQ(S.findings().Commands, 0U) << "it is not done";
  pixel::PixelUnit Tails{Memory};
  Teller Shown(S);
  Tails.setLog(&Shown);
  Tails.accept(Unit.takeHandOvers());
  EXPECT_TRUE(Tails.step());
  EXPECT_EQ(S.findings().Commands, 1U);
  EXPECT_EQ(S.findings().Tails, 1U);
  EXPECT_EQ(S.findings().NotReplayed, 0U);
}

} // namespace vorion::raster
