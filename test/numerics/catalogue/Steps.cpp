// The optimiser's step and the loss where their formulas divide by nearly
// nothing.
#include "TrainingCase.h"

#include "device/Values.h"
#include "picture/Layout.h"
#include "reference/Adam.h"
#include "reference/Loss.h"
#include "train/optimize/Adam.h"
#include "train/optimize/PictureLoss.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vorion::test {
namespace {

/// The rate of opacities, whose plane is looked at.
constexpr double Rate = 0.05;

/// Adam's first step on \p Gradients, from moments and parameters of 0.
Expected<Finding> firstStep(splat::Launcher &L,
                            const std::vector<float> &Gradients, double Bound) {
  L.beginStage(splat::Stage::Blend);
  L.build(splat::adamProgram());
  splat::DeviceScene S =
      splat::DeviceScene::upload(L, splat::Scene::sized(Gradients.size(), 0));
  std::vector<float> Planes(splat::GEOMETRY_PLANES * Gradients.size(), 0);
  std::ranges::copy(Gradients, Planes.begin() +
                                   static_cast<std::ptrdiff_t>(
                                       splat::PLANE_LOGIT * Gradients.size()));
  const std::vector<float> None(3 * Gradients.size(), 0);
  const splat::PlanePair All = S.allocate(L, S.Count);
  L.write("gradients", All.Geometry, Planes.data(), 4 * Planes.size());
  L.write("gradients", All.Sh, None.data(), 4 * None.size());
  splat::TrainSettings Settings;
  Settings.OpacityRate = Rate;
  splat::stepAdam(L, Settings, S, All, 1, 1, 0);
  const splat::Scene Got = S.download(L);
  if (L.failure())
    return *L.failure();

  Finding F;
  F.Bound = Bound;
  for (std::size_t I = 0; I < Gradients.size(); ++I) {
    reference::AdamMoments M;
    const double Want = reference::adamStep(double(Gradients[I]), 1, Rate, M);
    const double Off = std::abs(double(Got.OpacityLogits[I]) - Want);
    const double Error =
        Want == 0 ? (Off == 0 ? 0 : HUGE_VAL) : Off / std::abs(Want);
    if (!(Error <= F.Error))
      F.Error = Error;
    if (!(Error <= Bound) && F.Broken.empty())
      F.Broken = fmt::format("gradient {:.1g} steps by {:.6g}, expected {:.6g}",
                             Gradients[I], Got.OpacityLogits[I], Want);
  }
  return F;
}

/// A picture of one value in all channels against a photograph of one level;
/// the gradient in parts of a pixel's share of the loss.
Expected<Finding> constant(splat::Launcher &L, float Value, int Level,
                           double Bound) {
  constexpr int Width = 24, Height = 20;
  constexpr std::size_t Pixels = std::size_t{Width} * Height;
  L.beginStage(splat::Stage::Blend);
  L.build(splat::lossProgram());
  const splat::Photo Target{
      Width, Height,
      std::vector<uint8_t>(3 * Pixels, static_cast<uint8_t>(Level))};
  const std::vector<float> Picture(4 * Pixels, Value);
  splat::PictureLoss Loss(L, 0.2);
  const splat::LossValues Got = Loss.evaluate(upload(L, Picture), Target);
  const auto Gradient = splat::download<float>(L, Loss.gradient(), 3 * Pixels);
  if (L.failure())
    return *L.failure();

  const std::vector<glm::dvec3> X(Pixels, glm::dvec3(double(Value)));
  // As fp32 has it, so that equal is equal.
  const std::vector<glm::dvec3> Y(
      Pixels, glm::dvec3(double(static_cast<float>(Level) / 255.0F)));
  const reference::Loss Want = reference::lossOf(X, Y, Width, Height);
  Finding F;
  F.Bound = Bound;
  for (std::size_t I = 0; I < Pixels; ++I)
    for (std::size_t C = 0; C < 3; ++C) {
      const double Error = std::abs(Gradient[3 * I + C] -
                                    Want.Gradient[I][static_cast<int>(C)]) *
                           3 * double(Pixels);
      if (!(Error <= F.Error))
        F.Error = Error;
    }
  if (!(F.Error <= Bound))
    F.Broken = fmt::format("a gradient is off by {:.3g} of a pixel's share, "
                           "expected at most {:.3g}",
                           F.Error, Bound);
  else if (!(std::abs(Got.Value - Want.Value) <= 2e-5))
    F.Broken =
        fmt::format("loss {:.8g}, expected {:.8g}", Got.Value, Want.Value);
  return F;
}

/// The worst of several findings, the first broken one if there is one.
void take(Finding &Worst, const Finding &F) {
  Worst.Bound = F.Bound;
  if (!(F.Error <= Worst.Error))
    Worst.Error = F.Error;
  if (Worst.Broken.empty())
    Worst.Broken = F.Broken;
}

TrainingCase constants(const char *Name, const char *Why, float Offset,
                       std::vector<std::string> FoundIn) {
  constexpr double Bound = 1e-3;
  return {Name,
          Why,
          fmt::format("{:.0e} of a pixel's share of the loss", Bound),
          [Offset](splat::Launcher &L, const Way &) -> Expected<Finding> {
            Finding Worst;
            for (const int Level : {0, 1, 128, 255}) {
              const auto F = constant(
                  L, static_cast<float>(Level) / 255.0F + Offset, Level, Bound);
              if (!F)
                return F;
              take(Worst, *F);
            }
            return Worst;
          },
          std::move(FoundIn),
          /*Blends=*/false};
}

} // namespace

void addSteps(std::vector<TrainingCase> &Cases) {
  const auto Step = [&](const char *Name, const char *Why, double Bound,
                        const std::vector<float> &Gradients,
                        std::vector<std::string> FoundIn) {
    Cases.push_back(
        {Name, Why,
         fmt::format("{:.0e} of rate g / (\\|g\\| + epsilon)", Bound),
         [=](splat::Launcher &L, const Way &) {
           return firstStep(L, Gradients, Bound);
         },
         std::move(FoundIn),
         /*Blends=*/false});
  };
  Step("adam-first-step",
       "t = 1: the corrections are 10 and 1,000, and every step is its rate",
       1e-6, {1, -1, 1e-3F, -1e-6F, 1e-9F, 1e6F, -1e18F},
       {"adam-uncorrected", "adam-epsilon-under-the-root"});
  Step("adam-squares-of-nothing",
       "g^2 is subnormal in fp32, or 0: epsilon then decides", 2e-6,
       {0, 1e-19F, -1e-20F, 1e-21F, 1e-22F, -1e-23F, 1e-30F, 1e-38F},
       {"adam-without-epsilon", "adam-epsilon-under-the-root"});
  Cases.push_back(constants(
      "ssim-of-a-perfect-constant",
      "equal pictures of one level: variances cancel, and no gradient may move "
      "what is right",
      0, {"ssim-without-c1", "ssim-without-c2", "sign-of-equal"}));
  Cases.push_back(constants("ssim-of-another-constant",
                            "a level half a range below the photograph's: no "
                            "variance, so that all of "
                            "SSIM's slope is that of the means",
                            -0.5F, {"ssim-without-c2", "ssim-weight-lost"}));
}

} // namespace vorion::test
