// The backward mode: hand-over through CSRs, bad configurations, closed forms,
// and random scenes bit for bit against a scalar fp32 loop on every level.
#include "raster/BackwardLoop.h"
#include "raster/Datapath.h"

#include <cmath>
#include <random>

namespace vorion::raster {
namespace {

/// RasterTest with the planes of training: last contributors and gradients.
class BackwardTest : public RasterTest {
protected:
  static constexpr uint32_t Lasts = Records + 0x680000;
  static constexpr uint32_t Upstream = Records + 0x700000;

  void configureTraining() {
    set(Csr::Last, Lasts);
    set(Csr::Upstream, Upstream);
  }

  /// Renders \p Scene and keeps last contributors.
  void forward(std::span<const Gaussian> Scene, TileCommand T) {
    T.Mode = ModeKeepLast.put(1);
    configureTraining();
    render(Scene, T);
  }

  /// The same gradient at every pixel of a tile.
  void putUpstream(const Pixel &Gradient) {
    const std::vector<Pixel> All(64 * 64, Gradient);
    Memory.put(Upstream, std::span<const Pixel>(All));
  }

  /// Starts the backward command of what forward() rendered.
  void startBackward(uint32_t Options = 0) {
    set(Csr::Mode, ModeBackward.put(1));
    set(Csr::Backward, Options);
    set(Csr::Start, 1U);
    while (Unit.step()) {
    }
  }

  /// Takes the batch that is there, going on with what waits for room.
  uint32_t takeBatch() {
    EXPECT_TRUE(Agent.canTakeBatch());
    const uint32_t Next = Agent.read(Csr::GradNext, 0);
    while (Unit.step()) {
    }
    return Next;
  }

  GradientSums readLane(unsigned Lane) {
    GradientSums G;
    G.Tag = Agent.read(Csr::GradTag, Lane);
    constexpr auto First = static_cast<unsigned>(Csr::GradR),
                   Last = static_cast<unsigned>(Csr::GradSyy);
    for (unsigned K = 0; K <= Last - First; ++K)
      G.Sums[K] =
          std::bit_cast<float>(Agent.read(static_cast<Csr>(First + K), Lane));
    return G;
  }

  /// Drains a whole command: by entry of the list.
  std::vector<GradientSums> drain(std::size_t Entries) {
    std::vector<GradientSums> All(Entries);
    for (uint32_t Next; (Next = takeBatch()) != 0;)
      for (unsigned L = 0; L != GradNextCount.get(Next); ++L)
        All.at(VR_GRAD_LANES * GradNextBatch.get(Next) + L) = readLane(L);
    return All;
  }

  uint32_t status() { return Agent.read(Csr::Wait, 0); }
};

constexpr TileCommand Tall{.Width = 32, .Height = 64};

/// Thin Gaussians all over a tile, none of which hides another.
std::vector<Gaussian> thin(unsigned Count) {
  std::vector<Gaussian> Scene;
  for (unsigned I = 0; I != Count; ++I) {
    Scene.push_back(
        roundGaussian(4.0F + static_cast<float>(I), 20.25F, 6, 0.1F));
    Scene.back().Tag = 100 + I;
  }
  return Scene;
}

TEST_F(BackwardTest, RenderKeepsTheLastContributorOfEachPixel) {
  std::vector<Gaussian> Scene;
  // The second covers rows from 12.5 on, the third is too faint to be blended.
  Scene.push_back(roundGaussian(8.5F, 8.5F, 2, 0.5F));
  Scene.push_back(roundGaussian(8.5F, 15.5F, 1, 0.5F));
  Scene.push_back(roundGaussian(8.5F, 8.5F, 2, 0.003F));
  forward(Scene, Tall);
  const auto At = [&](unsigned X, unsigned Y) {
    return Memory.get<uint32_t>(Lasts + Y * Pitch / 4 + 4 * X, 1)[0];
  };
  EXPECT_EQ(At(8, 8), 1U);
  EXPECT_EQ(At(8, 14), 2U); // blended by both
  EXPECT_EQ(At(8, 17), 2U);
  EXPECT_EQ(At(20, 8), 0U);
  EXPECT_EQ(At(31, 63), 0U);
}

TEST_F(BackwardTest, TheGaussianThatSaturatesAPixelIsNotItsLast) {
  const std::vector<Gaussian> Scene(4, roundGaussian(8.5F, 8.5F, 9, 1));
  forward(Scene, {.Cutoff = 1e-3F, .Width = 16, .Height = 16});
  // 0.01 is left after the first, 1e-4 would be after the second.
  EXPECT_EQ(Memory.get<uint32_t>(Lasts + 8 * Pitch / 4 + 32, 1)[0], 1U);
}

TEST_F(BackwardTest, OneGaussianHasItsClosedForm) {
  const Gaussian G = roundGaussian(10.25F, 7.5F, 3, 0.6F, 0.9F, 0.5F, 0.1F);
  forward(std::array{G}, Tall);
  // One pixel, (12, 9), with centre 2.25 and 2 away.
  putUpstream({0, 0, 0, 0});
  const Pixel Gradient{1, -2, 0.5F, 0.75F};
  Memory.put(Upstream + 9 * Pitch + 12 * 16, std::span(&Gradient, 1));
  startBackward();
  const GradientSums S = drain(1)[0];
  EXPECT_EQ(status(), VR_OK);
  const double A = 0.6 * std::exp(-(2.25 * 2.25 + 4) / 18);
  const double ByAlpha = 0.9 - 2 * 0.5 + 0.5 * 0.1 - 0.75;
  const double Expected[] = {A,
                             -2 * A,
                             0.5 * A,
                             A * ByAlpha,
                             A * ByAlpha * 2.25,
                             A * ByAlpha * 2,
                             A * ByAlpha * 2.25 * 2.25,
                             A * ByAlpha * 2.25 * 2,
                             A * ByAlpha * 4};
  for (unsigned K = 0; K != 9; ++K)
    EXPECT_NEAR(S.Sums[K], Expected[K], 1e-6 * std::fabs(Expected[K])) << K;
}

TEST_F(BackwardTest, HandsOver16GaussiansAtATimeByTheirPlaceInTheList) {
  for (const unsigned Count : {1U, 15U, 16U, 17U, 33U}) {
    const auto Scene = thin(Count);
    forward(Scene, {.Width = 64, .Height = 32});
    putUpstream({1, 1, 1, 0});
    startBackward();
    unsigned Left = Count;
    while (Left != 0) {
      const uint32_t Next = takeBatch();
      const unsigned Batch = (Left - 1) / VR_GRAD_LANES;
      EXPECT_EQ(GradNextBatch.get(Next), Batch);
      EXPECT_EQ(GradNextCount.get(Next), Left - Batch * VR_GRAD_LANES);
      for (unsigned L = 0; L != VR_GRAD_LANES; ++L) {
        const bool Has = Batch * VR_GRAD_LANES + L < Left;
        EXPECT_EQ(readLane(L).Tag, Has ? 100 + Batch * VR_GRAD_LANES + L : 0U);
        EXPECT_EQ(readLane(L).Sums[0] != 0, Has);
      }
      Left = Batch * VR_GRAD_LANES;
    }
    EXPECT_EQ(takeBatch(), 0U);
    EXPECT_EQ(takeBatch(), 0U); // none queued
    EXPECT_EQ(readLane(0), GradientSums());
    EXPECT_EQ(status(), VR_OK);
  }
}

TEST_F(BackwardTest, BeginsAtTheLastEntryThatAnyPixelBlended) {
  auto Scene = thin(20);
  for (unsigned I = 5; I != 20; ++I)
    Scene[I].Mean[1] = 500; // elsewhere
  forward(Scene, {.Width = 64, .Height = 32});
  putUpstream({1, 1, 1, 0});
  startBackward();
  EXPECT_EQ(takeBatch(), GradNextCount.put(5));
  EXPECT_EQ(takeBatch(), 0U);
  EXPECT_EQ(Agent.counters().Gaussians, 20U + 5U);
}

TEST_F(BackwardTest, EmptyListsAndUntouchedTilesOnlyEnd) {
  forward({}, Tall);
  putUpstream({1, 1, 1, 1});
  startBackward();
  EXPECT_EQ(takeBatch(), 0U);
  EXPECT_EQ(status(), VR_OK);
  forward(std::array{roundGaussian(500, 500, 3, 0.5F)}, Tall);
  startBackward();
  EXPECT_EQ(takeBatch(), 0U);
  EXPECT_EQ(status(), VR_OK);
}

TEST_F(BackwardTest, HaltsUntilTheCoreTakesABatch) {
  const auto Scene = thin(16 * 5);
  forward(Scene, {.Width = 64, .Height = 32});
  putUpstream({1, 2, 3, 0});
  startBackward();
  EXPECT_FALSE(Unit.canStep()); // two batches wait
  EXPECT_TRUE(Agent.isBusy());
  EXPECT_TRUE(Agent.canTakeBatch());
  EXPECT_EQ(GradNextBatch.get(Agent.read(Csr::GradNext, 0)), 4U);
  EXPECT_TRUE(Unit.canStep());
  EXPECT_TRUE(Unit.step());
  EXPECT_FALSE(Unit.step());
  drain(Scene.size());
  EXPECT_FALSE(Agent.isBusy());
}

TEST_F(BackwardTest, ComputesOneBatchAheadOfThoseThatWait) {
  const auto Scene =
      std::vector(16 * 8, flatGaussian(32, 32, 100, 100, 1.0F / 128));
  forward(Scene, {.Width = 64, .Height = 32});
  putUpstream({1, 2, 3, 0});
  KeptWork Log;
  Unit.setLog(&Log);
  startBackward();
  EXPECT_EQ(Log.Fetched, 16U * 3);
  EXPECT_EQ(Log.Entries, 16U * 8);
  takeBatch();
  EXPECT_EQ(Log.Fetched, 16U * 4);
  EXPECT_TRUE(Log.Commands.empty());
  while (Log.Commands.empty())
    takeBatch();
  EXPECT_EQ(Log.Fetched, 16U * 8);
  EXPECT_TRUE(Agent.isBusy()) << "three batches and the end are left";
  for (unsigned Left = 3; Left != 0; --Left)
    EXPECT_NE(takeBatch(), 0U);
  EXPECT_EQ(takeBatch(), 0U);
  Unit.setLog(nullptr);
}

TEST_F(BackwardTest, CommandsOfAnAgentHandOverOneAfterTheOther) {
  const auto Scene = thin(3);
  forward(Scene, Tall);
  putUpstream({1, 2, 3, 0});
  set(Csr::Mode, ModeBackward.put(1));
  set(Csr::Start, 1U);
  EXPECT_FALSE(Agent.canTakeBatch()); // queued, and not begun
  set(Csr::Start, 1U);
  while (Unit.step()) {
  }
  EXPECT_EQ(takeBatch(), GradNextCount.put(3));
  EXPECT_EQ(takeBatch(), 0U);
  EXPECT_EQ(takeBatch(), GradNextCount.put(3));
  EXPECT_EQ(takeBatch(), 0U);
  EXPECT_EQ(Agent.counters().Commands, 3U);
}

TEST_F(BackwardTest, ARecordThatIsNotANumberEndsTheCommand) {
  auto Scene = thin(20);
  forward(Scene, {.Width = 64, .Height = 32});
  putUpstream({1, 1, 1, 0});
  Scene[3].Opacity = std::nanf("");
  Memory.put(Records, std::span<const Gaussian>(Scene));
  startBackward();
  EXPECT_EQ(GradNextBatch.get(takeBatch()), 1U); // what came before it
  EXPECT_EQ(takeBatch(), 0U);
  EXPECT_EQ(status(), VR_NAN);
}

TEST_F(BackwardTest, BadConfigurationsHaveTheirCodes) {
  struct Case {
    Csr Where;
    uint32_t Value, Status;
  };
  const uint32_t Backward = ModeBackward.put(1);
  const Case Cases[] = {
      {Csr::Mode, Backward | ModePushed.put(1), VR_BAD_MODE},
      {Csr::Mode, Backward | ModeDrain.put(1), VR_BAD_MODE},
      {Csr::Mode, Backward | ModeKeepLast.put(1), VR_BAD_MODE},
      {Csr::Mode, ModeKeepLast.put(1) | ModeDrain.put(1), VR_BAD_MODE},
      {Csr::Mode, ModeKeepLast.put(1) | ModePushed.put(1), VR_BAD_MODE},
      {Csr::Ztile, ZtileCount.put(2), VR_BAD_MODE},
      {Csr::Options, OptionsBlend.put(VR_BLEND_BF16), VR_BAD_MODE},
      {Csr::Backward, BackwardReciprocal.put(7), VR_BAD_MODE},
      {Csr::Backward, 1U << 5, VR_BAD_MODE},
      {Csr::TileShape, TileShapeWidth.put(33) | TileShapeHeight.put(64),
       VR_BAD_SHAPE},
      {Csr::TileShape, TileShapeWidth.put(65) | TileShapeHeight.put(8),
       VR_BAD_SHAPE},
      {Csr::TailCount, 3, VR_BAD_TAIL},
      {Csr::Last, Lasts + 2, VR_MISALIGNED},
      {Csr::Upstream, Upstream + 8, VR_MISALIGNED},
      {Csr::Last, Records + (8 << 20) - 1024, VR_UNMAPPED},
      {Csr::Upstream, Records + (8 << 20) - 4096, VR_UNMAPPED},
      {Csr::Output, 0, VR_UNMAPPED},
  };
  for (const Case &C : Cases) {
    configure(thin(2), Tall);
    configureTraining();
    set(Csr::Mode, Backward);
    set(Csr::Backward, 0U);
    set(Csr::TailCount, 0U);
    set(Csr::Options, 0U);
    set(C.Where, C.Value);
    const bool IsBackward = ModeBackward.get(Agent.read(Csr::Mode, 0)) != 0;
    set(Csr::Start, 1U);
    while (Unit.step()) {
    }
    if (IsBackward)
      EXPECT_EQ(takeBatch(), 0U);
    EXPECT_EQ(status(), C.Status)
        << std::hex << static_cast<unsigned>(C.Where) << " " << C.Value;
  }
}

TEST_F(BackwardTest, ClampStopsOnlyWhatGoesThroughAlpha) {
  const std::array Scene{roundGaussian(8.5F, 8.5F, 9, 1.05F)};
  forward(Scene, {.Width = 1, .Height = 1});
  putUpstream({1, 1, 1, 0});
  startBackward();
  EXPECT_NE(drain(1)[0].Sums[3], 0);
  set(Csr::TileOrigin, TileOriginX.put(8) | TileOriginY.put(8));
  set(Csr::Mode, ModeKeepLast.put(1));
  EXPECT_EQ(start(), VR_OK);
  startBackward(BackwardClampStops.put(1));
  const GradientSums S = drain(1)[0];
  EXPECT_NE(S.Sums[0], 0);
  EXPECT_EQ(S.Sums[3], 0);
}

// Random scenes.

Scene randomScene(uint32_t Seed) {
  std::mt19937 Engine(Seed);
  const auto Uniform = [&](double Low, double High) {
    return static_cast<float>(Low + (High - Low) * Engine() / 0x1p32);
  };
  Scene S;
  S.Width = 1 + Engine() % 64;
  S.Height = 1 + Engine() % std::min(64U, VR_MAX_BACKWARD / S.Width);
  S.X = Engine() % 2000;
  S.Y = Engine() % 2000;
  for (unsigned I = 0, N = 1 + Engine() % 60; I != N; ++I) {
    S.Gaussians.push_back(roundGaussian(
        static_cast<float>(S.X) + Uniform(-10, 70),
        static_cast<float>(S.Y) + Uniform(-10, 70), std::exp(Uniform(-0.5, 3)),
        Uniform(0, 1.05), Uniform(0, 1), Uniform(0, 1), Uniform(0, 1)));
    Gaussian &G = S.Gaussians.back();
    G.Conic[1] = Uniform(-0.6, 0.6) * G.Conic[0];
    G.Tag = I;
  }
  auto Tile = std::make_unique<TileBuffer>();
  Tile->reset(S.X, S.Y, S.Width, S.Height);
  BlendOptions Options{.StopBelow = 1e-4F,
                       .MinAlpha = 1.0F / 255.0F,
                       .SkipSaturated = false,
                       .KeepLast = true};
  for (; Options.Entry != S.Gaussians.size(); ++Options.Entry)
    datapaths().front()->Conics.Of[0][0](S.Gaussians[Options.Entry], Options,
                                         *Tile);
  for (unsigned Row = 0; Row != S.Height; ++Row)
    for (unsigned Column = 0; Column != S.Width; ++Column) {
      const unsigned At = Row * TileBuffer::Stride + Column;
      S.Rendered.push_back(
          {Tile->R[At], Tile->G[At], Tile->B[At], std::fabs(Tile->T[At])});
      S.Last.push_back(Tile->Last[At]);
      S.Upstream.push_back(
          {Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1)});
    }
  return S;
}

class EveryBackwardLevel
    : public testing::TestWithParam<const BackwardDatapath *> {};

INSTANTIATE_TEST_SUITE_P(Host, EveryBackwardLevel,
                         testing::ValuesIn(backwardDatapaths().begin(),
                                           backwardDatapaths().end()),
                         [](const auto &Info) {
                           return std::string(Info.param->Name);
                         });

TEST_P(EveryBackwardLevel, HasTheBitsOfTheScalarLoop) {
  for (uint32_t Seed = 0; Seed != 42; ++Seed) {
    const Scene S = randomScene(Seed);
    BackwardOptions O;
    O.Unit = static_cast<Reciprocal>(Seed % ReciprocalUnitCount);
    O.ClampStops = Seed % 3 == 0;
    O.InRows = Seed % 2 == 0;
    const auto Expected = scalarLoop(S, O), Actual = onLevel(*GetParam(), S, O);
    for (std::size_t I = 0; I != Expected.size(); ++I)
      ASSERT_EQ(std::memcmp(&Expected[I], &Actual[I], sizeof(GradientSums)), 0)
          << "seed " << Seed << " entry " << I;
  }
}

/// Relative difference of all sums from those of the same formulas in doubles.
double errorAgainstDoubles(const Scene &S,
                           const std::vector<GradientSums> &Actual) {
  std::vector<double> T(S.Last.size(), 0), Behind(S.Last.size(), 0);
  // Forward in doubles first: the transmittance behind all.
  std::vector<std::vector<std::pair<std::size_t, double>>> Seen(S.Last.size());
  for (std::size_t I = 0; I != S.Last.size(); ++I) {
    T[I] = 1;
    Behind[I] = S.Upstream[I].T;
    const double Px = S.X + I % S.Width + 0.5, Py = S.Y + I / S.Width + 0.5;
    for (std::size_t Entry = 0; Entry != S.Last[I]; ++Entry) {
      const Gaussian &G = S.Gaussians[Entry];
      const double Dx = G.Mean[0] - Px, Dy = G.Mean[1] - Py;
      if (std::fabs(Dx) > G.Extent[0] || std::fabs(Dy) > G.Extent[1])
        continue;
      const double Power =
          -0.5 * (G.Conic[0] * Dx * Dx + G.Conic[2] * Dy * Dy) -
          G.Conic[1] * Dx * Dy;
      const double Wanted = G.Opacity * std::exp(Power);
      if (Power > 0 || Wanted < 1. / 255)
        continue;
      Seen[I].emplace_back(Entry, Wanted);
      T[I] *= 1 - std::min(0.99, Wanted);
    }
  }
  std::vector<std::array<double, 4>> Sum(S.Gaussians.size());
  for (std::size_t I = 0; I != S.Last.size(); ++I)
    for (auto It = Seen[I].rbegin(); It != Seen[I].rend(); ++It) {
      const Gaussian &G = S.Gaussians[It->first];
      const Pixel &U = S.Upstream[I];
      const double Alpha = std::min(0.99, It->second);
      T[I] /= 1 - Alpha;
      const double Light = double(G.Color[0]) * U.R + double(G.Color[1]) * U.G +
                           double(G.Color[2]) * U.B;
      const double V = It->second * T[I] * (Light - Behind[I]);
      Behind[I] += Alpha * (Light - Behind[I]);
      const double Add[] = {Alpha * T[I] * U.R, Alpha * T[I] * U.G,
                            Alpha * T[I] * U.B, V};
      for (unsigned K = 0; K != 4; ++K)
        Sum[It->first][K] += Add[K];
    }
  double Difference = 0, Norm = 0;
  for (std::size_t I = 0; I != Sum.size(); ++I)
    for (unsigned K = 0; K != 4; ++K) {
      Difference += std::pow(Actual[I].Sums[K] - Sum[I][K], 2);
      Norm += std::pow(Sum[I][K], 2);
    }
  return std::sqrt(Difference / Norm);
}

TEST(Backward, TheExactUnitIsNearDoublesAndTheOthersAreWhereTheyShouldBe) {
  double Worst[ReciprocalUnitCount] = {};
  for (uint32_t Seed = 100; Seed != 110; ++Seed) {
    const Scene S = randomScene(Seed);
    for (unsigned U = 0; U != ReciprocalUnitCount; ++U) {
      BackwardOptions O;
      O.Unit = static_cast<Reciprocal>(U);
      Worst[U] = std::max(
          Worst[U],
          errorAgainstDoubles(S, onLevel(*backwardDatapaths().back(), S, O)));
    }
  }
  EXPECT_LT(Worst[0], 5e-6);
  EXPECT_LT(Worst[6], 5e-6);
  EXPECT_LT(Worst[5], 2e-4);
  EXPECT_GT(Worst[1], 0.01); // the paper's, table spaced evenly
  EXPECT_LT(Worst[4], Worst[2]);
}

} // namespace
} // namespace vorion::raster
