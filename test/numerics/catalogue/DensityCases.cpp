// Density control as Markov chain Monte Carlo, where nearly all or all
// Gaussians are dead.
#include "TrainingCase.h"

#include "Build.h"
#include "picture/Layout.h"
#include "scene/Activation.h"
#include "train/optimize/Mcmc.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vorion::test {
namespace {

constexpr uint64_t Seed = 11;
constexpr unsigned Iteration = 600;
constexpr std::size_t Alive = 17;
/// What share one place at most (mcmc.cl).
constexpr int MostShares = 51;

splat::TrainSettings settings() {
  splat::TrainSettings T;
  T.Method = splat::DensityMethod::Mcmc;
  T.GrowShare = 0;
  return T;
}

void build(splat::Launcher &L) {
  L.beginStage(splat::Stage::Blend);
  for (const splat::ProgramSpec &P : splat::densityPrograms())
    L.build(P);
  L.build(splat::mcmcProgram());
}

/// Dead in every way that a scene may have: faint, of opacity 0, without
/// rotation or size.
splat::Scene dead(std::size_t Count) {
  splat::Scene S = splat::Scene::sized(Count, 0);
  Numbers R(58);
  for (std::size_t I = 0; I < Count; ++I) {
    S.OpacityLogits[I] = I % 3 == 0 ? -3e38F : I % 3 == 1 ? -100.0F : -5.5F;
    S.Quats[4 * I] = I % 2 == 0 ? 1.0F : 0.0F;
    for (std::size_t K = 0; K < 3; ++K) {
      S.Means[3 * I + K] = static_cast<float>(R.uniform(-1, 1));
      S.LogScales[3 * I + K] = I % 5 == 0 ? -100.0F : -2.0F;
    }
  }
  return S;
}

constexpr double ShareBound = 1e-5;

/// Opacity and factor of the scales of each of \p Shares that together draw
/// what one of opacity \p All did: the integral of 1 - (1 - x e^(-t^2 / 2))^n
/// over t is that of \p All e^(-t^2 / 2). By Simpson's rule.
std::pair<double, double> shareOf(double All, int Shares) {
  const double One = -std::expm1(std::log1p(-All) / Shares);
  constexpr int Steps = 4000;
  constexpr double Reach = 12;
  double Sum = 0;
  for (int I = 0; I <= Steps; ++I) {
    const double T = Reach * I / Steps;
    const double Value =
        -std::expm1(Shares * std::log1p(-One * std::exp(-0.5 * T * T)));
    Sum += Value * (I == 0 || I == Steps ? 1 : I % 2 == 1 ? 4 : 2);
  }
  Sum *= Reach / Steps / 3;
  return {One, All * std::sqrt(std::acos(-1.0) / 2) / Sum};
}

/// All of 100 move to the one that is alive, which is opaque.
Expected<Finding> oneAlive(splat::Launcher &L) {
  constexpr std::size_t Count = 100;
  build(L);
  splat::Scene Before = dead(Count);
  Before.OpacityLogits[Alive] = 40;
  const splat::TrainSettings T = settings();
  splat::McmcControl Control(L, T, Seed);
  auto S = splat::DeviceScene::upload(L, Before);
  Control.change(S, Iteration);
  const splat::Scene After = S.download(L);
  // 1 in fp32 counts as the largest number below it.
  const auto [Opacity, Factor] = shareOf(1 - 0x1p-23, MostShares);
  Worst W(ShareBound);
  for (std::size_t I = 0; I < Count && !L.failure(); ++I) {
    W.take("a logit", double(After.OpacityLogits[I]),
           std::log(Opacity) - std::log1p(-Opacity), 1);
    for (std::size_t K = 0; K < 3; ++K) {
      W.take("a log scale", double(After.LogScales[3 * I + K]),
             double(Before.LogScales[3 * Alive + K]) + std::log(Factor), 1);
      W.demand(After.Means[3 * I + K] == Before.Means[3 * Alive + K],
               fmt::format("Gaussian {} is elsewhere, expected it where the "
                           "only one is that is alive",
                           I));
    }
  }
  return W.finding(L);
}

/// There is none to move to: an error says so.
Expected<Finding> allDead(splat::Launcher &L) {
  build(L);
  const splat::TrainSettings T = settings();
  splat::McmcControl Control(L, T, Seed);
  auto S = splat::DeviceScene::upload(L, dead(50));
  Control.change(S, Iteration);
  Finding F;
  if (!L.failure())
    F.Broken = "no error, expected one that says that all are transparent";
  else if (L.failure()->Code != ExitCode::LimitReached)
    return *L.failure();
  return F;
}

/// An opaque one and one without size stay to the bit; a dead one moves, and
/// all stay numbers.
Expected<Finding> steps(splat::Launcher &L) {
  constexpr std::size_t Count = 60;
  build(L);
  splat::Scene Before = dead(Count);
  for (std::size_t I = 0; I < Count; I += 4)
    Before.OpacityLogits[I] = I % 8 == 0 ? 3e38F : 30;
  const splat::TrainSettings T = settings();
  splat::McmcControl Control(L, T, Seed);
  auto S = splat::DeviceScene::upload(L, Before);
  Control.addNoise(S, Iteration, 80);
  const splat::Scene After = S.download(L);
  Worst W(0);
  for (std::size_t I = 0; I < Count; ++I) {
    const bool Stays = I % 4 == 0 || Before.LogScales[3 * I] < -50;
    for (std::size_t K = 0; K < 3; ++K) {
      const double Step =
          double(After.Means[3 * I + K]) - double(Before.Means[3 * I + K]);
      W.demand(std::isfinite(Step) && (Step == 0) == Stays,
               fmt::format("Gaussian {} steps by {:.3g}, expected it to {}", I,
                           Step, Stays ? "stay" : "move"));
    }
  }
  return W.finding(L);
}

} // namespace

void addDensity(std::vector<TrainingCase> &Cases) {
  Cases.push_back(withoutBlending(
      "mcmc-one-alive",
      "99 of 100 are dead, and the last one is opaque: all move to it, and "
      "more share its place than one may be shared by",
      fmt::format("{:.0e} of equation 9 for {} shares, there exactly",
                  ShareBound, MostShares),
      oneAlive, {"dead-are-drawn", "shares-unbounded"}));
  Cases.push_back(withoutBlending(
      "mcmc-all-dead", "every opacity is 0 or as good: there is none to draw",
      "an error says so", allDead, {"dead-are-drawn"}));
  Cases.push_back(withoutBlending(
      "mcmc-steps-of-extremes",
      "opacities of 0 and 1, no rotation, no size: exp of a large number is "
      "infinite",
      "opaque ones and those without size stay to the bit, others move", steps,
      {"opaque-take-steps"}));
}

} // namespace vorion::test
