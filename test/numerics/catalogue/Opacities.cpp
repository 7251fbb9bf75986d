// Opaque and faint stacks, alpha at its thresholds, order by depth, colours.
#include "Build.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vorion::test {
namespace {

/// \p Depth flat layers that fill the picture, front to back in turn.
HardCase stack(int Depth, double Opacity) {
  HardCase C{
      fmt::format("opaque-stack-{}-{}", Depth, Opacity == 1 ? "1" : "0.99"),
      Opacity == 1
          ? "opacity 1: alpha is cut to 0.99, so that T falls to the "
            "cut-off 1e-4 itself, where fp32 and fp64 decide differently"
          : "opacity 0.99: 1 - alpha has lost 7 bits, and the second "
            "layer's T lies at the cut-off",
      {},
      frontView(20, 18, 50),
      {}};
  Numbers R(static_cast<uint32_t>(Depth));
  for (int I = 0; I < Depth; ++I)
    add(C.Scene, {.Mean = {0, 0, static_cast<float>(2 + 0.05 * I)},
                  .Scale = {40, 40, 40},
                  .Opacity = Opacity,
                  .Color = R.color()});
  C.MostDoubtful = 1;
  C.FoundIn = {"opacity-of-9-bits"};
  if (Opacity == 1)
    C.FoundIn = {"alpha-reaches-1",
                 // fp64 does not stop at the second layer either.
                 Depth == 2 ? "negative-tiles-wrap" : "never-stops"};
  return C;
}

HardCase halfStack() {
  HardCase C{"half-stack-64",
             "alpha 0.5: T is a power of two, and 64 layers never reach the "
             "last ones",
             {},
             frontView(20, 18, 50),
             {}};
  Numbers R(9);
  for (int I = 0; I < 64; ++I)
    add(C.Scene, {.Mean = {0, 0, static_cast<float>(2 + 0.05 * I)},
                  .Scale = {40, 40, 40},
                  .Opacity = 0.5,
                  .Color = R.color()});
  C.MostDoubtful = 0.1;
  C.FoundIn = {"list-cut-at-8"};
  return C;
}

HardCase faint() {
  HardCase C{"faint-4000",
             "4,000 layers of alpha 0.0045: each rounding of T counts two "
             "thousand times",
             {},
             frontView(12, 12, 50),
             {}};
  Numbers R(10);
  for (int I = 0; I < 4000; ++I)
    add(C.Scene, {.Mean = {0, 0, static_cast<float>(2 + 0.001 * I)},
                  .Scale = {40, 40, 40},
                  .Opacity = 0.0045,
                  .Color = R.color()});
  C.Cap = 3e-5;
  C.MostDoubtful = 0.05;
  C.FoundIn = {"opacity-of-9-bits", "transmittance-of-bf16"};
  return C;
}

HardCase thresholds() {
  HardCase C{"alpha-thresholds",
             "alpha at 1/255, 0.5 and 0.99, and one ulp beside them, in a "
             "pixel's centre",
             {},
             frontView(64, 48, 50),
             {}};
  int I = 0;
  for (const double Opacity : {1. / 255, 0.5, 0.99}) {
    const float Logit =
        static_cast<float>(std::log(Opacity) - std::log1p(-Opacity));
    for (const int Ulps : {-2, -1, 0, 1, 2}) {
      float L = Logit;
      for (int K = 0; K < std::abs(Ulps); ++K)
        L = std::nextafter(L, Ulps < 0 ? -100.0F : 100.0F);
      // Pixel (4 I + 2, 24) exactly: 50 x / 2 + 32 = 4 I + 2.5.
      add(C.Scene, {.Mean = {static_cast<float>((4 * I - 29.5) / 25), 0.02F, 2},
                    .Scale = {0.01, 0.01, 0.01}});
      C.Scene.OpacityLogits.back() = L;
      ++I;
    }
  }
  C.ExpectedCulls[2] =
      3; // 1/255 less two ulps, one, and 1/255 as a logit gives it
  C.FoundIn = {"alpha-cut-at-200th", "opacity-of-9-bits"};
  return C;
}

/// Overlapping opaque discs whose depths are \p Depth(i).
template <typename Function>
HardCase depths(const std::string &Name, const std::string &Why,
                splat::Camera View, Function Depth) {
  HardCase C{Name, Why, {}, std::move(View), {}};
  Numbers R(12);
  for (int I = 0; I < 48; ++I)
    add(C.Scene, {.Mean = seenAt(C.View, R.uniform(-1.2, 1.2),
                                 R.uniform(-0.9, 0.9), Depth(I)),
                  .Scale = {0.25, 0.25, 0.25},
                  .Opacity = 0.9,
                  .Color = R.color()});
  C.Cap = 1e-4;
  return C;
}

HardCase equalDepths() {
  HardCase C = depths("equal-depths", "48 at one depth: the file's order holds",
                      frontView(64, 48, 50), [](int) { return 3.0; });
  C.FoundIn = {"ties-reversed"};
  return C;
}

HardCase ulpDepths() {
  splat::Camera V = turnedView(frontView(64, 48, 50));
  V.Position = {30, -20, 50};
  HardCase C = depths("depths-one-ulp-apart",
                      "in a turned view from (30, -20, 50): a plain sum ties "
                      "and swaps what the exact depths order",
                      V, [](int I) { return 3 + 0x1p-22 * ((I * 29) % 48); });
  C.Cap = 1e-3; // x and y of means at 50 have 22 bits behind the camera
  C.FoundIn = {"depth-by-plain-sum"};
  return C;
}

HardCase colors() {
  HardCase C{"sh-clamped-at-0",
             "harmonics of degree 3 below 0 on one side: the colour is cut "
             "there, never negative",
             {},
             frontView(64, 48, 50),
             {}};
  Numbers R(13);
  for (int I = 0; I < 30; ++I)
    add(C.Scene, {.Mean = {static_cast<float>(R.uniform(-1.5, 1.5)),
                           static_cast<float>(R.uniform(-1, 1)),
                           static_cast<float>(R.uniform(2.5, 5))},
                  .Scale = {0.15, 0.15, 0.15},
                  .Opacity = 0.7,
                  .Color = {0.1, 0, -0.2}});
  const splat::Scene Constant = C.Scene;
  C.Scene.ShDegree = 3;
  C.Scene.Sh.clear();
  for (std::size_t I = 0; I < Constant.size(); ++I) {
    for (std::size_t K = 0; K < 3; ++K)
      C.Scene.Sh.push_back(Constant.Sh[3 * I + K]);
    for (int K = 0; K < 45; ++K)
      C.Scene.Sh.push_back(static_cast<float>(R.uniform(-0.6, 0.6)));
  }
  C.FoundIn = {"negative-colors"};
  return C;
}

} // namespace

void addOpacities(std::vector<HardCase> &Cases) {
  for (const double Opacity : {0.99, 1.0})
    for (const int Depth : {2, 3, 8, 64})
      Cases.push_back(stack(Depth, Opacity));
  Cases.push_back(halfStack());
  Cases.push_back(faint());
  Cases.push_back(thresholds());
  Cases.push_back(equalDepths());
  Cases.push_back(ulpDepths());
  Cases.push_back(colors());
}

} // namespace vorion::test
