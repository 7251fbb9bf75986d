#include "GradientJudge.h"

#include "Build.h"
#include "Convert.h"
#include "Gradients.h"
#include "Judge.h"
#include "io/Metrics.h"
#include "reference/AlongRays.h"
#include "render/Gradients.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace vorion::test {
namespace {

/// A random loss as the device takes it and as the reference does.
struct Loss {
  splat::PixelGradients Device;
  reference::Upstream Reference;
};

/// Of pixels with none of the doubts \p Counted.
Loss lossFor(const std::vector<uint8_t> &Doubts, int Counted) {
  Loss Out;
  Numbers R(77);
  for (const uint8_t Doubt : Doubts) {
    float V[4];
    for (float &X : V)
      X = (Doubt & Counted) == 0 ? static_cast<float>(R.uniform(-1, 1)) : 0;
    Out.Device.Render.insert(Out.Device.Render.end(), V, V + 3);
    Out.Device.Alpha.push_back(V[3]);
    Out.Reference.Render.emplace_back(V[0], V[1], V[2]);
    Out.Reference.Alpha.push_back(V[3]);
  }
  return Out;
}

/// One kind of gradient, \c Each numbers a Gaussian, as \c Of gives number K of
/// Gaussian I in fp64.
struct Kind {
  const char *Name;
  const std::vector<float> &Got;
  std::size_t Each;
  std::function<double(std::size_t I, std::size_t K)> Of;
};

std::vector<Kind> kindsOf(const splat::SceneGradients &Got,
                          const reference::Gradients &Want,
                          const std::vector<double> &Lengths,
                          std::size_t Coefficients) {
  const auto Part = [](const auto &All) {
    return [&All](std::size_t I, std::size_t K) {
      return All[I][static_cast<int>(K)];
    };
  };
  std::vector<Kind> Kinds{
      {"mean", Got.Means, 3, Part(Want.Means)},
      {"scale", Got.Scales, 3, Part(Want.Scales)},
      {"quaternion", Got.Quats, 4,
       [&](std::size_t I, std::size_t K) {
         return Want.Quats[I][static_cast<int>(K)] / Lengths[I];
       }},
      {"opacity", Got.Opacities, 1,
       [&](std::size_t I, std::size_t) { return Want.Opacities[I]; }},
      {"projected mean", Got.Means2d, 2, Part(Want.Means2d)},
      {"colour", Got.Sh, 3 * Coefficients,
       [&, Coefficients](std::size_t I, std::size_t K) {
         return Want.Sh[Coefficients * I + K / 3][static_cast<int>(K % 3)];
       }}};
  if (!Want.Conics.empty()) // those of footprints
    Kinds.push_back({"conic", Got.Conics, 3, Part(Want.Conics)});
  return Kinds;
}

} // namespace

Expected<Finding> judgeGradients(splat::Launcher &L, const Way &W,
                                 const GradientScene &S, double Bound) {
  splat::RenderOptions O = S.Options;
  O.Blending = W.Blending;
  O.Training = true;
  // Those that are drawn, and where they are in the whole scene.
  splat::Scene Drawn = splat::Scene::sized(0, S.Scene.ShDegree);
  std::vector<uint32_t> Places;
  for (uint32_t I = 0; I < S.Scene.size(); ++I)
    if (std::ranges::find(S.Culled, I) == S.Culled.end()) {
      append(Drawn, S.Scene, I, 1);
      Places.push_back(I);
    }
  const reference::Options Rules = referenceOptions(O);
  const auto G = splat::toReference<double>(Drawn);
  const auto View = splat::toReference<double>(S.View);
  const bool IsAlongRays = splat::hasRayRecords(O.Kind);
  const auto Picture =
      IsAlongRays ? reference::renderAlongRays(G, View, Rules)
                  : reference::blend(reference::project(G, View, Rules),
                                     View.Width, View.Height, Rules);
  const Loss Given =
      lossFor(Picture.Doubts, S.AreTied ? ~reference::DoubtOrder : ~0);
  const auto Want =
      IsAlongRays
          ? reference::alongRaysBackward(G, View, Given.Reference, Rules)
          : reference::renderBackward(G, View, Given.Reference, Rules);

  splat::BackwardOptions Back;
  Back.Pixels = W.Sums;
  const auto R =
      splat::takeGradients(L, S.Scene, S.View, O, Back, Given.Device);
  if (!R)
    return R.error();
  std::vector<double> Lengths;
  for (std::size_t I = 0; I < Drawn.size(); ++I) {
    const float *Q = &Drawn.Quats[4 * I];
    // Shorter ones have the gradient of this length (project_backward.cl).
    Lengths.push_back(
        std::max(glm::length(glm::dvec4(Q[0], Q[1], Q[2], Q[3])), 0x1p-103));
  }
  double LogScales = 0;
  for (std::size_t I = 0; I < Drawn.size(); ++I)
    for (int K = 0; K < 3; ++K)
      LogScales += std::pow(Want.Scales[I][K] * G.Scales[I][K], 2);

  Finding F;
  F.Bound = Bound;
  if (R->Visible != Drawn.size())
    F.Broken =
        fmt::format("{} Gaussians seen, expected {}", R->Visible, Drawn.size());
  std::size_t Silent = 0;
  for (std::size_t I = 0; I < Places.size(); ++I) {
    const bool Is = R->Gradients.Opacities[Places[I]] == 0;
    Silent += Is;
    if (S.Silent && Is != (Want.Opacities[I] == 0))
      F.Broken =
          fmt::format("Gaussian {} has {} by its opacity, which fp64 has "
                      "not",
                      Places[I], Is ? "no gradient" : "a gradient");
  }
  if (S.Silent && Silent != *S.Silent && F.Broken.empty())
    F.Broken = fmt::format("{} Gaussians without gradient, expected {}", Silent,
                           *S.Silent);
  for (const Kind &K :
       kindsOf(R->Gradients, Want, Lengths, S.Scene.coefficients())) {
    for (const uint32_t I : S.Culled)
      for (std::size_t N = 0; N < K.Each; ++N)
        if (!(K.Got[I * K.Each + N] == 0))
          F.Broken = fmt::format("culled Gaussian {} has {} gradient {:.3g}, "
                                 "expected 0",
                                 I, K.Name, K.Got[I * K.Each + N]);
    // Round Gaussians' quaternions have none: see numerics.md.
    const double Least =
        K.Name == std::string("quaternion") ? 1e-3 * std::sqrt(LogScales) : 0;
    std::vector<double> Ours, Right;
    for (std::size_t I = 0; I < Places.size(); ++I)
      for (std::size_t N = 0; N < K.Each; ++N) {
        Ours.push_back(K.Got[Places[I] * K.Each + N]);
        Right.push_back(K.Of(I, N));
        if (std::isnan(Right.back()))
          F.Broken = fmt::format("{} gradient of the reference is not a number",
                                 K.Name);
      }
    const double Error = splat::relativeL2(Ours, Right, Least);
    // Not a number must be the worst.
    if (!(Error <= F.Error))
      F.Error = Error;
    if (!(Error <= Bound) && F.Broken.empty())
      F.Broken = fmt::format("{} gradient off by {:.3g}, expected at most "
                             "{:.3g}",
                             K.Name, Error, Bound);
  }
  return F;
}

} // namespace vorion::test
