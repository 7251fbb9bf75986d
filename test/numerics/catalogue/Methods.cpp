// Masks, exposures and weights on parameters, with inputs at the ends of their
// ranges.
#include "TrainingCase.h"

#include "Build.h"
#include "device/Values.h"
#include "picture/Layout.h"
#include "reference/Loss.h"
#include "train/optimize/Adam.h"
#include "train/optimize/Exposure.h"
#include "train/optimize/PictureLoss.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace vorion::test {
namespace {

constexpr double MaskBound = 1e-4;

/// One pixel of many counts. What does not count may be anything.
Expected<Finding> maskOfOnePixel(splat::Launcher &L) {
  constexpr int Width = 150, Height = 100;
  constexpr std::size_t Pixels = std::size_t{Width} * Height;
  constexpr std::size_t Counted = std::size_t{Width} * 41 + 77;
  L.beginStage(splat::Stage::Loss);
  L.build(splat::lossProgram());
  L.build(splat::maskProgram());
  std::vector<float> Picture(4 * Pixels,
                             std::numeric_limits<float>::infinity());
  splat::Photo Target{Width, Height, std::vector<uint8_t>(3 * Pixels, 200)};
  std::vector<uint8_t> Counts(Pixels, 0);
  std::vector<glm::dvec3> X(Pixels, glm::dvec3(0)), Y = X;
  Counts[Counted] = 1;
  const float Shown[3] = {0.25F, 0.75F, 200.0F / 255.0F};
  for (std::size_t K = 0; K < 3; ++K) {
    Picture[4 * Counted + K] = Shown[K];
    X[Counted][static_cast<int>(K)] = double(Shown[K]);
    Y[Counted][static_cast<int>(K)] = double(200.0F / 255.0F);
  }
  splat::PictureLoss Loss(L, 0.2);
  const splat::LossValues Got =
      Loss.evaluate(upload(L, Picture), Target, Counts);
  const auto Gradient = splat::download<float>(L, Loss.gradient(), 3 * Pixels);
  // By definition the means are over the pixels that count.
  const reference::Loss Want = reference::lossOf(X, Y, Width, Height);
  Worst W(MaskBound);
  W.take("the loss", Got.Value, Want.Value * Pixels, 1);
  for (std::size_t I = 0; I < Pixels; ++I)
    for (std::size_t K = 0; K < 3; ++K) {
      const auto Is = double(Gradient[3 * I + K]);
      if (Counts[I] == 0)
        W.demand(Is == 0, fmt::format("pixel {} has the gradient {:.3g}, "
                                      "expected 0, because it does not count",
                                      I, Is));
      else
        W.take("a gradient", 3 * Is,
               3 * Want.Gradient[I][static_cast<int>(K)] * Pixels, 1);
    }
  return W.finding(L);
}

constexpr double ExposureBound = 1e-5;

/// Black pictures through any matrix: only the offsets show, and only they have
/// a gradient.
Expected<Finding> exposureOfBlack(splat::Launcher &L) {
  constexpr uint32_t Pixels = 5000; // two groups
  L.beginStage(splat::Stage::Loss);
  L.build(splat::exposureProgram());
  splat::TrainSettings T;
  T.ExposureRate = 0.01;
  const cl::Buffer Black = upload(L, std::vector<float>(4 * Pixels, 0));
  Numbers R(57);
  Worst W(ExposureBound);
  for (const float Size : {0.0F, 1.0F, 1e6F}) {
    splat::Exposures E(L, T, 2);
    std::vector<float> State = E.save();
    for (std::size_t K = 0; K < 12; ++K)
      State[K] = Size * static_cast<float>(R.uniform(-1, 1));
    E.restore(State);
    std::vector<float> Upstream(3 * Pixels);
    double Sums[3] = {}, Sizes[3] = {};
    for (std::size_t I = 0; I < Upstream.size(); ++I) {
      Upstream[I] = static_cast<float>(R.uniform(-1, 1));
      Sums[I % 3] += double(Upstream[I]);
      Sizes[I % 3] += std::abs(double(Upstream[I]));
    }
    const auto Exposed =
        splat::download<float>(L, E.apply(Black, Pixels, 0), 4 * Pixels);
    const cl::Buffer Slopes = upload(L, Upstream);
    const splat::ExposureMatrix By = E.back(Black, Slopes, Pixels, 0);
    const auto Back = splat::download<float>(L, Slopes, 3 * Pixels);
    for (std::size_t C = 0; C < 3; ++C) {
      W.take("a channel", double(Exposed[4 * 4321 + C]),
             double(State[4 * C + 3]), 1);
      for (std::size_t K = 0; K < 3; ++K)
        W.demand(By[4 * C + K] == 0,
                 "a factor of black has a gradient, expected 0");
      W.take("an offset's gradient", By[4 * C + 3], Sums[C], Sizes[C]);
      double Want = 0, Whole = 0;
      for (std::size_t K = 0; K < 3; ++K) {
        const double Part =
            double(State[4 * K + C]) * double(Upstream[3 * 4321 + K]);
        Want += Part;
        Whole += std::abs(Part);
      }
      W.take("a pixel's gradient", double(Back[3 * 4321 + C]), Want, Whole);
    }
    // A step moves offsets alone; the mean of both pictures takes half.
    splat::Exposures Stepped(L, T, 2);
    Stepped.step({{0, By}}, 1);
    const splat::ExposureMatrix M = Stepped.matrix(0);
    for (std::size_t K = 0; K < 12; ++K)
      W.demand(K % 4 == 3 ? std::abs(M[K]) > 0.004
                          : M[K] == (K % 5 == 0 ? 1 : 0),
               fmt::format("a step by black takes term {} to {:.9g}", K, M[K]));
  }
  return W.finding(L);
}

constexpr double WeightBound = 1e-5;

/// Opacities from 0 to 1 and scales from 0 to 5e34, all that a scene may store.
Expected<Finding> weightsOfExtremes(splat::Launcher &L) {
  const std::vector<float> Logits{-3e38F, -100, -30, -5, 0, 5, 30, 100, 3e38F};
  const std::vector<float> Logs{-3e38F, -100, -40, -5, 0, 5, 20, 40, 80};
  const std::size_t Count = Logits.size();
  splat::Scene Of = splat::Scene::sized(Count, 0);
  for (std::size_t I = 0; I < Count; ++I) {
    Of.OpacityLogits[I] = Logits[I];
    for (std::size_t K = 0; K < 3; ++K)
      Of.LogScales[3 * I + K] = Logs[(I + K) % Count];
  }
  splat::TrainSettings T;
  T.OpacityWeight = 0.3;
  T.ScaleWeight = 0.7;
  L.beginStage(splat::Stage::Loss);
  L.build(splat::regularizeProgram());
  const auto S = splat::DeviceScene::upload(L, Of);
  const splat::PlanePair By{
      upload(L, std::vector<float>(splat::GEOMETRY_PLANES * Count, 0)), {}};
  splat::regularize(L, T, S, By);
  const auto Got =
      splat::download<float>(L, By.Geometry, splat::GEOMETRY_PLANES * Count);
  Worst W(WeightBound);
  for (std::size_t I = 0; I < Count; ++I) {
    const double O = 1 / (1 + std::exp(-double(Logits[I])));
    const double Each = T.OpacityWeight / double(Count);
    W.take("an opacity's gradient", double(Got[splat::PLANE_LOGIT * Count + I]),
           Each * O * (1 - O), Each);
    for (std::size_t K = 0; K < 3; ++K) {
      const double Scale = std::exp(double(Of.LogScales[3 * I + K]));
      const double Want = T.ScaleWeight / (3 * double(Count)) * Scale;
      W.take("a scale's gradient",
             double(Got[(splat::PLANE_LOG_SCALE + K) * Count + I]), Want,
             std::max(Want, 1e-30));
    }
  }
  return W.finding(L);
}

} // namespace

void addMethods(std::vector<TrainingCase> &Cases) {
  Cases.push_back(withoutBlending(
      "mask-of-one-pixel",
      "all but one of 15,000 pixels are masked, and infinite: means are over "
      "one pixel, and nothing else goes back",
      fmt::format("{:.0e} of fp64's loss and gradient, others 0", MaskBound),
      maskOfOnePixel, {"mask-by-product", "mask-forgotten-behind"}));
  Cases.push_back(withoutBlending(
      "exposure-of-black",
      "black pictures, matrices of 0 to 1e6: factors do nothing, and have no "
      "gradient",
      fmt::format("{:.0e} of the affine map's, factors 0", ExposureBound),
      exposureOfBlack, {"exposure-offset-lost"}));
  Cases.push_back(withoutBlending(
      "weights-of-extremes",
      "weights on opacities of 0 and 1, on scales of 0 and 5e34",
      fmt::format("{:.0e} of o (1 - o) and of the scale", WeightBound),
      weightsOfExtremes, {"weight-of-a-logit"}));
}

} // namespace vorion::test
