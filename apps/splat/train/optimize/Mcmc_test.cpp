// Draws, shares and steps against what they are defined as, on the host.
#include "train/optimize/Mcmc.h"

#include "device/OnDevice.h"
#include "picture/Layout.h"
#include "render/Planes.h"
#include "scene/Activation.h"
#include "train/data/Philox.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace vorion::splat {
namespace {

constexpr uint64_t Seed = 0x500000007;
constexpr unsigned Iteration = 600;

class McmcOnDevice : public OnDevice {
protected:
  static Scene sample(uint32_t Count, double FaintShare) {
    std::mt19937 Random(3);
    std::normal_distribution<float> Normal;
    std::uniform_real_distribution<double> Unit(0, 1);
    Scene S = Scene::sized(Count, 1);
    for (std::vector<float> *V : {&S.Means, &S.Quats, &S.Sh})
      std::ranges::generate(*V, [&] { return Normal(Random); });
    for (float &V : S.LogScales)
      V = -3 + Normal(Random);
    for (float &V : S.OpacityLogits)
      V = opacityLogit(Unit(Random) < FaintShare ? 0.004 * Unit(Random)
                                                 : 0.006 + 0.99 * Unit(Random));
    return S;
  }

  void build(Launcher &L) {
    L.beginStage(Stage::Blend);
    for (const ProgramSpec &P : densityPrograms())
      L.build(P);
    L.build(mcmcProgram());
  }

  /// Draws by the definition: opacities in whole parts are the weights.
  static std::vector<std::size_t> drawn(const std::vector<double> &Opacities,
                                        uint32_t Draws, uint32_t Kind) {
    // Their sum fits into 32 bits.
    const auto Scale = static_cast<float>(
        std::min(16777216.0,
                 0.999 * 4294967295.0 / static_cast<double>(Opacities.size())));
    std::vector<uint32_t> Sums{0};
    for (const double O : Opacities)
      Sums.push_back(Sums.back() +
                     static_cast<uint32_t>(static_cast<float>(O) * Scale));
    std::vector<std::size_t> Sources;
    for (uint32_t J = 0; J < Draws; ++J) {
      const philox_words W = philox(static_cast<uint32_t>(Seed), Seed >> 32, J,
                                    Kind, Iteration, STREAM_DRAW);
      const uint32_t Wanted =
          static_cast<uint32_t>(uint64_t{W.word[0]} * Sums.back() >> 32);
      Sources.push_back(static_cast<std::size_t>(
          std::ranges::upper_bound(Sums, Wanted) - Sums.begin() - 1));
    }
    return Sources;
  }

  /// What \p Shares of one of opacity \p All are to be: opacity, and factor of
  /// the scales (Kheradmand et al. 2024, equation 9).
  static std::pair<double, double> shareOf(double All, int Shares) {
    using Wide = long double;
    const Wide One = 1 - std::pow(1 - Wide(All), Wide(1) / Shares);
    Wide Sum = 0;
    for (int I = 1; I <= Shares; ++I) {
      Wide Binomial = 1;
      for (int K = 0; K < I; ++K) {
        Sum += Binomial * (K % 2 == 0 ? 1 : -1) / std::sqrt(Wide(K + 1)) *
               std::pow(One, Wide(K + 1));
        Binomial = Binomial * (I - 1 - K) / (K + 1);
      }
    }
    return {static_cast<double>(One), static_cast<double>(All / Sum)};
  }

  DeviceScene withMoments(Launcher &L, const Scene &Of) {
    DeviceScene S = DeviceScene::upload(L, Of);
    S.First.Geometry = upload(
        L, std::vector<float>(std::size_t{GEOMETRY_PLANES} * S.Count, 5));
    S.Second.Sh = upload(
        L, std::vector<float>(std::size_t{S.colourPlanes()} * S.Count, 6));
    return S;
  }
};

// Of an opacity of 1 the logarithm of what is left is infinite.
TEST_F(McmcOnDevice, WhatIsOpaqueIsSharedOutInNumbers) {
  constexpr uint32_t Count = 200;
  TrainSettings T;
  T.Method = DensityMethod::Mcmc;
  T.GrowShare = 0.05;
  Scene Before = sample(Count, 0.3);
  for (float &V : Before.OpacityLogits)
    V = V < opacityLogit(0.005) ? V : 40;
  Launcher L(*Dev, "", {});
  build(L);
  McmcControl Control(L, T, Seed);
  DeviceScene S = withMoments(L, Before);
  Control.change(S, Iteration);
  Control.addNoise(S, Iteration, 1);
  const Scene After = S.download(L);
  ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
  EXPECT_EQ(After.size(), 210U);
  EXPECT_TRUE(checkFinite("after", After));
}

TEST_F(McmcOnDevice, TheFaintMoveToPlacesDrawnByOpacity) {
  constexpr uint32_t Count = 900;
  TrainSettings T;
  T.Method = DensityMethod::Mcmc;
  T.GrowShare = 0;
  const Scene Before = sample(Count, 0.2);
  Launcher L(*Dev, "", {});
  build(L);
  McmcControl Control(L, T, Seed);
  DeviceScene S = withMoments(L, Before);
  const DensityChange C = Control.change(S, Iteration);
  const Scene After = S.download(L);
  const auto Identities = S.downloadIdentities(L);
  const auto First = download<float>(L, S.First.Geometry.onDevice(),
                                     std::size_t{GEOMETRY_PLANES} * Count);
  const auto Second = download<float>(L, S.Second.Sh.onDevice(),
                                      std::size_t{S.colourPlanes()} * Count);
  ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
  EXPECT_EQ(C.Before, Count);
  EXPECT_EQ(C.After, Count);

  std::vector<double> Opacities = activate<double>(Before).Opacities;
  std::vector<std::size_t> Dead;
  for (std::size_t I = 0; I < Count; ++I)
    if (Opacities[I] <= 0.005) {
      Dead.push_back(I);
      Opacities[I] = 0;
    }
  ASSERT_GT(Dead.size(), 100U);
  const auto Sources = drawn(Opacities, static_cast<uint32_t>(Dead.size()), 0);
  std::vector<int> Shares(Count, 1);
  for (const std::size_t From : Sources)
    ++Shares[From];
  EXPECT_GE(*std::ranges::max_element(Shares), 3);
  // Where each comes from.
  std::vector<std::size_t> Of(Count);
  for (std::size_t I = 0; I < Count; ++I)
    Of[I] = I;
  for (std::size_t J = 0; J < Dead.size(); ++J)
    Of[Dead[J]] = Sources[J];
  for (std::size_t I = 0; I < Count; ++I) {
    const std::size_t From = Of[I];
    const bool Changed = Shares[From] > 1;
    const auto [One, Factor] = shareOf(Opacities[From], Shares[From]);
    const double Opacity = std::max(One, 0.005);
    EXPECT_NEAR(After.OpacityLogits[I],
                Changed ? std::log(Opacity / (1 - Opacity))
                        : Before.OpacityLogits[From],
                2e-5)
        << I;
    for (std::size_t K = 0; K < 3; ++K) {
      EXPECT_NEAR(After.LogScales[3 * I + K],
                  Before.LogScales[3 * From + K] +
                      (Changed ? std::log(Factor) : 0),
                  2e-6);
      EXPECT_EQ(After.Means[3 * I + K], Before.Means[3 * From + K]);
      EXPECT_EQ(After.Sh[12 * I + 7 + K], Before.Sh[12 * From + 7 + K]);
    }
    EXPECT_EQ(After.Quats[4 * I + 2], Before.Quats[4 * From + 2]);
    EXPECT_EQ(Identities[I] == I, From == I);
    EXPECT_EQ(First[PLANE_LOGIT * Count + I], Changed ? 0 : 5);
    EXPECT_EQ(Second[4 * Count + I], Changed ? 0 : 6);
  }
  auto Sorted = Identities;
  std::ranges::sort(Sorted);
  EXPECT_EQ(std::ranges::adjacent_find(Sorted), Sorted.end());
}

TEST_F(McmcOnDevice, MoreAreDrawnWhileThereIsRoom) {
  constexpr uint32_t Count = 400;
  TrainSettings T;
  T.Method = DensityMethod::Mcmc;
  const Scene Before = sample(Count, 0);
  for (const auto &[Most, Want] : {std::pair(1000U, 420U), {411U, 411U}}) {
    T.MostGaussians = Most;
    Launcher L(*Dev, "", {});
    build(L);
    McmcControl Control(L, T, Seed);
    DeviceScene S = withMoments(L, Before);
    EXPECT_EQ(Control.change(S, Iteration).After, Want);
    const Scene After = S.download(L);
    const auto Identities = S.downloadIdentities(L);
    const auto First = download<float>(L, S.First.Geometry.onDevice(),
                                       std::size_t{GEOMETRY_PLANES} * Want);
    ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
    const auto Sources =
        drawn(activate<double>(Before).Opacities, Want - Count, 1);
    ASSERT_EQ(After.size(), Want);
    for (std::size_t J = 0; J < Sources.size(); ++J) {
      EXPECT_EQ(After.Means[3 * (Count + J)], Before.Means[3 * Sources[J]]);
      EXPECT_EQ(After.OpacityLogits[Count + J],
                After.OpacityLogits[Sources[J]]);
      EXPECT_LT(After.OpacityLogits[Count + J],
                Before.OpacityLogits[Sources[J]]);
      EXPECT_EQ(First[PLANE_LOGIT * Want + Count + J], 0);
      EXPECT_EQ(First[PLANE_LOGIT * Want + Sources[J]], 5);
      EXPECT_GE(Identities[Count + J], Count);
    }
  }
}

TEST_F(McmcOnDevice, WhereAllAreTransparentNothingIsDrawn) {
  TrainSettings T;
  T.Method = DensityMethod::Mcmc;
  Launcher L(*Dev, "", {});
  build(L);
  McmcControl Control(L, T, Seed);
  DeviceScene S = DeviceScene::upload(L, sample(50, 1));
  Control.change(S, Iteration);
  ASSERT_TRUE(L.failure());
  EXPECT_EQ(L.failure()->Code, ExitCode::LimitReached);
}

/// The covariance times normal numbers, for those that are nearly transparent.
TEST_F(McmcOnDevice, StepsAreTheCovarianceTimesNormalNumbers) {
  constexpr uint32_t Count = 200;
  constexpr double Rate = 40;
  const TrainSettings T;
  const Scene Before = sample(Count, 0.5);
  Launcher L(*Dev, "", {});
  build(L);
  McmcControl Control(L, T, Seed);
  DeviceScene S = DeviceScene::upload(L, Before);
  Control.addNoise(S, Iteration, Rate);
  const Scene After = S.download(L);
  ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
  const auto A = activate<double>(Before);
  double Largest = 0;
  for (uint32_t I = 0; I < Count; ++I) {
    const philox_words W = philox(static_cast<uint32_t>(Seed), Seed >> 32, I, 0,
                                  Iteration, STREAM_NOISE);
    const auto Pi = std::acos(-1.0);
    const double Near = std::sqrt(-2 * std::log(philox_unit(W.word[0])));
    const double Far = std::sqrt(-2 * std::log(philox_unit(W.word[2])));
    const double N[] = {Near * std::cos(2 * Pi * philox_unit(W.word[1])),
                        Near * std::sin(2 * Pi * philox_unit(W.word[1])),
                        Far * std::cos(2 * Pi * philox_unit(W.word[3]))};
    const double *Q = &A.Quats[4 * I];
    const double R[3][3] = {
        {1 - 2 * (Q[2] * Q[2] + Q[3] * Q[3]), 2 * (Q[1] * Q[2] - Q[0] * Q[3]),
         2 * (Q[1] * Q[3] + Q[0] * Q[2])},
        {2 * (Q[1] * Q[2] + Q[0] * Q[3]), 1 - 2 * (Q[1] * Q[1] + Q[3] * Q[3]),
         2 * (Q[2] * Q[3] - Q[0] * Q[1])},
        {2 * (Q[1] * Q[3] - Q[0] * Q[2]), 2 * (Q[2] * Q[3] + Q[0] * Q[1]),
         1 - 2 * (Q[1] * Q[1] + Q[2] * Q[2])}};
    const double Share =
        Rate / (1 + std::exp(-100 * ((1 - A.Opacities[I]) - 0.995)));
    for (std::size_t Row = 0; Row < 3; ++Row) {
      double Step = 0, Size = 0;
      for (std::size_t Column = 0; Column < 3; ++Column) {
        double Covariance = 0;
        for (std::size_t K = 0; K < 3; ++K) {
          const double Scale = A.Scales[3 * I + K];
          Covariance += R[Row][K] * Scale * Scale * R[Column][K];
          Size += Share * Scale * Scale * std::abs(N[Column]);
        }
        Step += Share * Covariance * N[Column];
      }
      const double Was = Before.Means[3 * I + Row];
      EXPECT_NEAR(After.Means[3 * I + Row], Was + Step,
                  2e-6 * (Size + std::abs(Was)));
      Largest = std::max(Largest, std::abs(Step));
    }
  }
  EXPECT_GT(Largest, 0.1);
}

} // namespace
} // namespace vorion::splat
