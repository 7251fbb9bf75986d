// The device's density control against the reference's rule.
#include "train/optimize/Density.h"

#include "device/OnDevice.h"
#include "picture/Layout.h"
#include "reference/Density.h"
#include "render/Plan.h"
#include "render/Planes.h"
#include "scene/Activation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace vorion::splat {
namespace {

using reference::Fate;

class DensityOnDevice : public OnDevice {
protected:
  static constexpr double Extent = 3;

  /// Opacities and scales on both sides of every threshold.
  Scene sample(uint32_t Count) {
    Scene S = Scene::sized(Count, 1);
    std::uniform_real_distribution<float> LogScale(-6, 0), Logit(-7, 2);
    std::normal_distribution<float> Normal;
    for (auto *Values : {&S.Means, &S.Quats, &S.Sh})
      std::ranges::generate(*Values, [&] { return Normal(Random); });
    std::ranges::generate(S.LogScales, [&] { return LogScale(Random); });
    std::ranges::generate(S.OpacityLogits, [&] { return Logit(Random); });
    return S;
  }

  DensityNotes sampleNotes(uint32_t Count) {
    std::uniform_real_distribution<float> Gradient(0, 2e-3F), Radius(0, 40);
    DensityNotes N;
    for (uint32_t I = 0; I < Count; ++I) {
      N.Views.push_back(Random() % 6);
      N.GradientSums.push_back(N.Views[I] == 0 ? 0 : Gradient(Random));
      N.Radii.push_back(Radius(Random));
    }
    return N;
  }

  std::vector<Fate> fates(const Scene &S, const DensityNotes &N,
                          const TrainSettings &T, unsigned Iteration) {
    const double Never = std::numeric_limits<double>::infinity();
    const bool Large = dropsLargeAt(T, Iteration);
    const reference::DensityRule Rule{T.DensifyGradient,
                                      T.SplitExtent * Extent,
                                      T.SplitShrink,
                                      T.LeastOpacity,
                                      Large ? T.MostExtent * Extent : Never,
                                      Large ? T.MostRadius : Never,
                                      T.MostGaussians};
    const auto A = activate<double>(S);
    std::vector<reference::DensityFacts> Facts;
    for (std::size_t I = 0; I < S.size(); ++I)
      Facts.push_back({N.Views[I] ? N.GradientSums[I] / N.Views[I] : 0,
                       std::max({A.Scales[3 * I], A.Scales[3 * I + 1],
                                 A.Scales[3 * I + 2]}),
                       A.Opacities[I], N.Radii[I]});
    return fatesOf(Facts, Rule);
  }

  void build(Launcher &L) {
    L.beginStage(Stage::Blend);
    for (const ProgramSpec &P : densityPrograms())
      L.build(P);
  }
};

TEST_F(DensityOnDevice, LeavesWhatTheReferencesRuleLeaves) {
  constexpr uint32_t Count = 1500;
  for (const auto &[Iteration, Most] : {std::pair(600U, 1U << 20),
                                        {600U, 1700U},
                                        {600U, 900U},
                                        {3100U, 1U << 20}}) {
    Launcher L(*Dev, "", {});
    build(L);
    TrainSettings T;
    T.MostGaussians = Most;
    DensityControl D(L, T, 99, Extent);
    const Scene Before = sample(Count);
    const DensityNotes Notes = sampleNotes(Count);
    DeviceScene S = DeviceScene::upload(L, Before);
    // Moments that can be told apart: number of the value plus one.
    std::vector<float> Moments(std::size_t{GEOMETRY_PLANES} * Count);
    for (std::size_t I = 0; I < Moments.size(); ++I)
      Moments[I] = static_cast<float>(I + 1);
    S.First.Geometry = upload(L, Moments);
    D.restore(Notes);
    const DensityChange C = D.densify(S, Iteration);
    const Scene After = S.download(L);
    const auto First = download<float>(L, S.First.Geometry.onDevice(),
                                       std::size_t{GEOMETRY_PLANES} * S.Count);

    const std::vector<Fate> Want = fates(Before, Notes, T, Iteration);
    const std::vector<uint32_t> Identities = S.downloadIdentities(L);
    std::size_t At = 0, Splits = 0, Clones = 0;
    const std::size_t Left = std::accumulate(
        Want.begin(), Want.end(), std::size_t{0},
        [](std::size_t Sum, Fate F) { return Sum + becomes(F); });
    ASSERT_EQ(After.size(), Left);
    EXPECT_EQ(C.Before, Count);
    EXPECT_EQ(C.After, Left);
    for (std::size_t I = 0; I < Count; ++I)
      for (std::size_t Child = 0; Child < becomes(Want[I]); ++Child, ++At) {
        const bool Split = Want[I] == Fate::Split;
        for (std::size_t K = 0; K < 3; ++K) {
          EXPECT_NEAR(After.LogScales[3 * At + K],
                      Before.LogScales[3 * I + K] - Split * std::log(1.6),
                      1e-6);
          if (!Split)
            EXPECT_EQ(After.Means[3 * At + K], Before.Means[3 * I + K]);
          EXPECT_EQ(After.Sh[12 * At + 5 + K], Before.Sh[12 * I + 5 + K]);
        }
        EXPECT_EQ(After.OpacityLogits[At], Before.OpacityLogits[I]);
        EXPECT_EQ(After.Quats[4 * At + 3], Before.Quats[4 * I + 3]);
        const bool Kept = Child == 0 && !Split;
        EXPECT_EQ(First[PLANE_LOGIT * S.Count + At],
                  Kept ? Moments[PLANE_LOGIT * Count + I] : 0);
        EXPECT_EQ(Identities[At] == I, Kept);
        Splits += Split;
        Clones += Want[I] == Fate::Clone;
      }
    EXPECT_EQ(std::set(Identities.begin(), Identities.end()).size(), Left);
    if (Most >= 1700) {
      EXPECT_GT(Splits, 20U);
      EXPECT_GT(Clones, 20U);
    }
    // It begins to note anew.
    const DensityNotes Now = D.save(S.Count);
    EXPECT_TRUE(std::ranges::all_of(Now.Views, [](auto V) { return V == 0; }));
    EXPECT_TRUE(std::ranges::all_of(Now.Radii, [](float V) { return V == 0; }));
  }
}

/// Halves of many Gaussians alike: samples of it, and the same each time.
TEST_F(DensityOnDevice, HalvesAreSamplesOfWhatTheyReplace) {
  constexpr uint32_t Count = 4000;
  Scene Before = Scene::sized(Count, 0);
  const double Scales[] = {0.5, 2, 0.1};
  for (std::size_t I = 0; I < Count; ++I) {
    for (std::size_t K = 0; K < 3; ++K) {
      Before.Means[3 * I + K] = static_cast<float>(K);
      Before.LogScales[3 * I + K] = static_cast<float>(std::log(Scales[K]));
    }
    // A third of a turn about (1, 1, 1): x of the Gaussian is y of the world,
    // y is z and z is x; turned the other way they would be others.
    for (std::size_t K = 0; K < 4; ++K)
      Before.Quats[4 * I + K] = 2;
  }
  const DensityNotes Notes{std::vector<float>(Count, 1),
                           std::vector<uint32_t>(Count, 1),
                           std::vector<float>(Count, 0)};
  const auto Split = [&](uint64_t Seed, unsigned Iteration) {
    Launcher L(*Dev, "", {});
    build(L);
    const TrainSettings T;
    DensityControl D(L, T, Seed, Extent);
    DeviceScene S = DeviceScene::upload(L, Before);
    D.restore(Notes);
    D.densify(S, Iteration);
    return S.download(L).Means;
  };
  const std::vector<float> Means = Split(1, 600);
  ASSERT_EQ(Means.size(), 6 * std::size_t{Count});
  const double Wanted[] = {0.1, 0.5, 2};
  for (std::size_t K = 0; K < 3; ++K) {
    double Sum = 0, Squares = 0, Fourth = 0, Halves = 0;
    for (std::size_t I = K; I < Means.size(); I += 3) {
      const double D = (Means[I] - double(K)) / Wanted[K];
      Sum += D;
      Squares += D * D;
      Fourth += D * D * D * D;
      if (I % 6 < 3)
        Halves += D * (Means[I + 3] - double(K)) / Wanted[K];
    }
    const double N = 2 * Count;
    EXPECT_NEAR(Sum / N, 0, 0.05);
    EXPECT_NEAR(Squares / N, 1, 0.08);
    EXPECT_NEAR(Fourth / N, 3, 0.5);
    EXPECT_NEAR(Halves / Count, 0, 0.08);
  }
  EXPECT_EQ(Means, Split(1, 600));
  EXPECT_NE(Means, Split(2, 600));
  EXPECT_NE(Means, Split(1, 700));
}

/// Where a threshold is met by rounding alone, runs that are otherwise equal
/// decide differently about one Gaussian: the others then still split the same.
TEST_F(DensityOnDevice, OneFateMovesNoOtherGaussiansHalves) {
  constexpr uint32_t Count = 300, Odd = 7;
  const Scene Start = sample(Count);
  // Every Gaussian's mean by its identity, after two changes in which all that
  // are opaque enough grow; the odd one is transparent or not.
  const auto Grown = [&](float OddLogit) {
    Launcher L(*Dev, "", {});
    build(L);
    const TrainSettings T;
    DensityControl D(L, T, 3, Extent);
    Scene Before = Start;
    Before.OpacityLogits[Odd] = OddLogit;
    DeviceScene S = DeviceScene::upload(L, Before);
    for (const unsigned Iteration : {600U, 700U}) {
      D.restore({std::vector<float>(S.Count, 1),
                 std::vector<uint32_t>(S.Count, 1),
                 std::vector<float>(S.Count, 0)});
      D.densify(S, Iteration);
    }
    const Scene After = S.download(L);
    const std::vector<uint32_t> Identities = S.downloadIdentities(L);
    EXPECT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
    std::map<uint32_t, std::array<float, 3>> Means;
    for (std::size_t I = 0; I < After.size(); ++I)
      Means[Identities[I]] = {After.Means[3 * I], After.Means[3 * I + 1],
                              After.Means[3 * I + 2]};
    EXPECT_EQ(Means.size(), After.size());
    return Means;
  };
  const auto Without = Grown(-20), With = Grown(1);
  EXPECT_EQ(With.size(), Without.size() + 4); // of two changes
  for (const auto &[Identity, Mean] : Without) {
    const auto Same = With.find(Identity);
    ASSERT_NE(Same, With.end());
    EXPECT_EQ(Same->second, Mean);
  }
  EXPECT_GT(Without.size(), 2 * Count); // children of children among them
}

TEST_F(DensityOnDevice, NotesAddUpOverTheViewsThatSawIt) {
  Launcher L(*Dev, "", {});
  build(L);
  const TrainSettings T;
  DensityControl D(L, T, 1, Extent);
  constexpr uint32_t Count = 20;
  std::vector<splat_gaussian> Records(Count);
  std::vector<uint32_t> Depths(Count, 5);
  std::vector<float> Gradients(3 * Count, 7); // the plane before is another's
  for (uint32_t I = 0; I < Count; ++I) {
    // Standard deviations 2 and 4 px along the axes: radius 12.
    Records[I].conic[0] = 0.25F;
    Records[I].conic[2] = 0.0625F;
    Gradients[Count + I] = 0.03F;
    Gradients[2 * Count + I] = 0.04F * static_cast<float>(I);
  }
  Depths[7] = CULLED + CULL_FAINT;
  D.restart(Count);
  const SeenView V{
      upload(L, Records), upload(L, Depths), upload(L, Gradients), 1, 200, 100};
  D.note(V, Count);
  D.note(V, Count);
  const DensityNotes N = D.save(Count);
  EXPECT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
  EXPECT_EQ(N.Views[0], 2U);
  EXPECT_NEAR(N.GradientSums[0], 2 * 3, 1e-5);
  EXPECT_NEAR(N.GradientSums[2], 2 * 5, 1e-5); // 3 and 4
  EXPECT_EQ(N.Radii[0], 12);
  EXPECT_EQ(N.Views[7], 0U);
  EXPECT_EQ(N.GradientSums[7], 0);
  EXPECT_EQ(N.Radii[7], 0);
}

TEST_F(DensityOnDevice, ResetLowersOpacitiesAndForgetsTheirMoments) {
  Launcher L(*Dev, "", {});
  build(L);
  const TrainSettings T;
  DensityControl D(L, T, 1, Extent);
  const Scene Before = sample(100);
  DeviceScene S = DeviceScene::upload(L, Before);
  const std::vector<float> Ones(std::size_t{GEOMETRY_PLANES} * 100, 1);
  S.First.Geometry = upload(L, Ones);
  S.Second.Geometry = upload(L, Ones);
  D.resetOpacity(S);
  const Scene After = S.download(L);
  const float Most = opacityLogit(0.01);
  for (std::size_t I = 0; I < 100; ++I)
    EXPECT_EQ(After.OpacityLogits[I], std::min(Before.OpacityLogits[I], Most));
  EXPECT_EQ(After.LogScales, Before.LogScales);
  for (const MomentPlanes &B : {S.First.Geometry, S.Second.Geometry}) {
    const auto M = B.values(L, Ones.size());
    EXPECT_EQ(M[PLANE_LOGIT * 100 + 50], 0);
    EXPECT_EQ(M[PLANE_LOGIT * 100 - 1], 1);
  }
}

} // namespace
} // namespace vorion::splat
