// Gaussians along rays (docs/cameras.md): rays from inside, along needles and
// in discs, and what has no size, forward and backward.
#include "Build.h"
#include "Convert.h"
#include "GradientJudge.h"
#include "Judge.h"
#include "lens/Models.h"

#include "picture/View.h"
#include "reference/AlongRays.h"
#include "render/Renderer.h"
#include "scene/Activation.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace vorion::test {
namespace {

constexpr double PictureBound = 1e-5, GradientBound = 1e-5;

struct RayCase {
  splat::Scene Scene;
  splat::Camera View;
  splat::RenderOptions Options;
  /// What the device culls, and fp64 does without.
  Culled ExpectedCulls{};
  // May be left out: NOLINTNEXTLINE(readability-redundant-member-init)
  std::vector<uint32_t> LeftOut{};
  /// Depths are equal to the bit, of which the file's order decides, so that no
  /// order is doubtful.
  bool AreTied = false;
  double Bound = PictureBound;
};

RayCase rayCase(int Width, int Height, double Focal, float Near) {
  RayCase C{{}, frontView(Width, Height, Focal), {}};
  C.Options.Kind = splat::RendererKind::Ray;
  C.Options.Dilation = 0;
  C.Options.Near = Near;
  return C;
}

RayCase surfels(RayCase C) {
  C.Options.Kind = splat::RendererKind::Surfel;
  splat::flatten(C.Scene);
  return C;
}

RayCase ofDegree4(RayCase C) {
  C.Options.FalloffDegree = 4;
  return C;
}

/// With \p PerUnit pixels for each unit.
void makeParallel(RayCase &C, double PerUnit) {
  C.View.Optics = splat::CameraModel{&splat::lenses::Orthographic};
  C.View.Fx = C.View.Fy = PerUnit;
  C.Options.Optics = C.View.Optics.Model;
}

splat::Scene without(const splat::Scene &S, const std::vector<uint32_t> &Out) {
  splat::Scene Rest = splat::Scene::sized(0, S.ShDegree);
  for (uint32_t I = 0; I < S.size(); ++I)
    if (std::ranges::find(Out, I) == Out.end())
      append(Rest, S, I, 1);
  return Rest;
}

Expected<Finding> judgePicture(splat::Launcher &L, const Way &W,
                               const RayCase &C) {
  splat::RenderOptions O = C.Options;
  O.Blending = W.Blending;
  const splat::ViewFacts Facts =
      splat::factsOf(C.Scene, splat::makeView(C.View, O), O);
  const auto R = splat::render(
      L, splat::planRender(splat::EffectPlan({}, {C.Scene, O, Facts}), O),
      C.Scene, C.View, O, /*KeepPairs=*/false);
  if (!R)
    return R.error();
  const auto Want = reference::renderAlongRays(
      splat::toReference<double>(without(C.Scene, C.LeftOut)),
      splat::toReference<double>(C.View), referenceOptions(O));
  Finding F;
  F.Bound = C.Bound;
  std::size_t Judged = 0;
  for (std::size_t I = 0; I < Want.Doubts.size(); ++I) {
    if ((Want.Doubts[I] & (C.AreTied ? ~reference::DoubtOrder : ~0)) != 0)
      continue;
    ++Judged;
    for (std::size_t K = 0; K < 3; ++K) {
      const double Error = std::abs(double(R->Picture.Render[3 * I + K]) -
                                    Want.Render[I][static_cast<int>(K)]);
      if (!(Error <= F.Error))
        F.Error = Error;
    }
  }
  if (!(F.Error <= C.Bound))
    F.Broken =
        fmt::format("error {:.3g}, expected at most {:.3g}", F.Error, C.Bound);
  else if (Judged < Want.Doubts.size() * 49 / 50)
    F.Broken = fmt::format("{} of {} pixels are certain, expected 98 %", Judged,
                           Want.Doubts.size());
  else if (!std::ranges::all_of(R->Picture.Render,
                                [](float V) { return std::isfinite(V); }))
    F.Broken = "a pixel is no finite number";
  else if (Want.Blends == 0)
    F.Broken = "nothing is blended, expected something";
  else if (!std::ranges::equal(R->Culled, C.ExpectedCulls))
    F.Broken = fmt::format("culled {}, expected {}", fmt::join(R->Culled, " "),
                           fmt::join(C.ExpectedCulls, " "));
  return F;
}

TrainingCase pictureOf(std::string Name, std::string Why, RayCase C,
                       std::vector<std::string> FoundIn = {}) {
  return {std::move(Name), std::move(Why),
          fmt::format("{:.0e} of fp64 along rays", C.Bound),
          [Shared = std::make_shared<RayCase>(std::move(C))](splat::Launcher &L,
                                                             const Way &W) {
            return judgePicture(L, W, *Shared);
          },
          std::move(FoundIn)};
}

TrainingCase gradientsOf(const std::string &Name, std::string Why, RayCase C,
                         std::vector<std::string> FoundIn = {}) {
  GradientScene S{std::move(C.Scene), C.View, C.Options, std::move(C.LeftOut)};
  S.AreTied = C.AreTied;
  return {"gradients-of-" + Name, std::move(Why),
          fmt::format("{:.0e} of the fp64 gradients{}", GradientBound,
                      S.Culled.empty() ? "" : ", culled ones 0"),
          [Shared = std::make_shared<GradientScene>(std::move(S))](
              splat::Launcher &L, const Way &W) {
            return judgeGradients(L, W, *Shared, GradientBound);
          },
          std::move(FoundIn)};
}

uint64_t &culledAs(RayCase &C, std::string_view Reason) {
  return C.ExpectedCulls[static_cast<std::size_t>(
      std::ranges::find(splat::CullReasons, Reason) -
      splat::CullReasons.begin())];
}

/// Rays begin inside of each, and have some of them behind.
RayCase fromInside() {
  RayCase C = rayCase(48, 36, 30, 0.01F);
  Numbers R(101);
  for (int I = 0; I < 40; ++I)
    add(C.Scene,
        {.Mean = {static_cast<float>(R.uniform(-1, 1)),
                  static_cast<float>(R.uniform(-1, 1)),
                  static_cast<float>(R.uniform(0.02, 1.5))},
         .Scale = {R.uniform(0.3, 2), R.uniform(0.3, 2), R.uniform(0.3, 2)},
         .Quat = R.turn(),
         .Opacity = R.uniform(0.05, 0.3),
         .Color = R.color()});
  return C;
}

/// A needle or a disc that the middle of the picture sees end-on, and others
/// nearly so.
RayCase alongNeedles(bool Parallel) {
  RayCase C = rayCase(48, 36, 60, 0.2F);
  if (Parallel)
    makeParallel(C, 20);
  Numbers R(102);
  for (int I = 0; I < 30; ++I) {
    const double Tilt = I % 3 == 0 ? 0 : R.uniform(-0.02, 0.02);
    // The middle of a pixel is on the axis of every third.
    const double X = 0.05 * (I % 7 - 3) + 0.025, Y = 0.05 * (I % 5 - 2) + 0.025;
    const double Z = 2 + 0.01 * I;
    add(C.Scene, {.Mean = {static_cast<float>(X), static_cast<float>(Y),
                           static_cast<float>(Z)},
                  .Scale = {0.02, 0.02, 0.5},
                  .Quat = {static_cast<float>(std::cos(Tilt)), 0,
                           static_cast<float>(std::sin(Tilt)), 0},
                  .Opacity = R.uniform(0.2, 0.6),
                  .Color = R.color()});
  }
  return C;
}

/// One scale of 0: a disc. Two or three: a line or a point, which no ray meets.
RayCase withoutThickness() {
  RayCase C = rayCase(48, 36, 40, 0.2F);
  Numbers R(103);
  for (int I = 0; I < 30; ++I) {
    const int Flat = I % 3;
    const int Zeros = I < 24 ? 1 : I < 27 ? 2 : 3;
    std::array<double, 3> Scale{};
    for (int K = 0; K < 3; ++K)
      Scale[static_cast<std::size_t>((Flat + K) % 3)] =
          K < Zeros ? 0 : R.uniform(0.1, 0.4);
    if (Zeros > 1) {
      C.LeftOut.push_back(static_cast<uint32_t>(C.Scene.size()));
      ++culledAs(C, Zeros == 2 ? "degenerate" : "non_finite");
    }
    add(C.Scene, {.Mean = {static_cast<float>(R.uniform(-0.8, 0.8)),
                           static_cast<float>(R.uniform(-0.6, 0.6)),
                           static_cast<float>(R.uniform(1.5, 2.5))},
                  .Scale = Scale,
                  .Quat = R.turn(),
                  .Opacity = R.uniform(0.2, 0.8),
                  .Color = R.color()});
  }
  return C;
}

/// A disc of no thickness in which the rays of a column lie.
RayCase inTheDisc(bool Parallel) {
  RayCase C = rayCase(33, 25, 40, 0.2F);
  if (Parallel)
    makeParallel(C, 20);
  // Its axes are the picture's, the normal being right, to the bit.
  add(C.Scene, {.Mean = {0, 0, 2},
                .Scale = {0.3, 0.3, 0},
                .Quat = {0.5F, 0.5F, 0.5F, 0.5F}});
  C.LeftOut = {0};
  ++culledAs(C, "degenerate");
  Numbers R(104);
  for (int I = 0; I < 12; ++I)
    add(C.Scene, {.Mean = {static_cast<float>(R.uniform(-0.3, 0.3)),
                           static_cast<float>(R.uniform(-0.2, 0.2)),
                           static_cast<float>(R.uniform(1.8, 2.2))},
                  .Opacity = R.uniform(0.2, 0.6),
                  .Color = R.color()});
  return C;
}

/// Surfels from the edge, to the bit and nearly, and smaller than a pixel: the
/// low pass alone draws some. Rays of the middle column lie in some if the
/// width is odd.
RayCase edges(bool Parallel, int Width = 33) {
  RayCase C = rayCase(Width, 25, 40, 0.2F);
  if (Parallel)
    makeParallel(C, 20);
  Numbers R(107);
  for (int I = 0; I < 24; ++I) {
    const double Tilt = I % 3 == 0 ? 0 : R.uniform(-0.02, 0.02);
    const double Size = I % 4 == 0 ? 1e-4 : R.uniform(0.05, 0.4);
    const auto Half = static_cast<float>(std::sqrt(0.5));
    // The normal is right, or nearly so, and passes the eye.
    add(C.Scene,
        {.Mean = {I % 3 == 0 ? 0 : static_cast<float>(R.uniform(-0.4, 0.4)),
                  static_cast<float>(R.uniform(-0.4, 0.4)),
                  static_cast<float>(R.uniform(1.8, 2.2))},
         .Scale = {Size, Size * R.uniform(0.3, 1), 0},
         .Quat = {Half * static_cast<float>(1 + Tilt), 0, Half, 0},
         .Opacity = R.uniform(0.2, 0.8),
         .Color = R.color()});
  }
  return surfels(std::move(C));
}

/// All centres are one point, through which a ray goes.
RayCase coincident() {
  RayCase C = rayCase(33, 25, 40, 0.2F);
  C.AreTied = true;
  Numbers R(105);
  for (int I = 0; I < 20; ++I)
    add(C.Scene, {.Scale = {R.uniform(0.05, 0.3), R.uniform(0.05, 0.3),
                            R.uniform(0.05, 0.3)},
                  .Quat = R.turn(),
                  .Opacity = R.uniform(0.1, 0.5),
                  .Color = R.color()});
  return C;
}

/// As far as numbers go: what is beyond them is culled, the rest is seen.
RayCase extremes() {
  RayCase C = rayCase(48, 36, 40, 0.2F);
  C.AreTied = true;
  Numbers R(106);
  const Blob Seen[] = {
      {.Scale = {1e19, 1e19, 1e19}, .Opacity = 0.3},
      {.Scale = {1e6, 1e6, 1e6}, .Opacity = 0.3},
      {.Mean = {0, 0, 1e6F}, .Scale = {1e5, 1e5, 1e5}, .Opacity = 0.5},
      {.Scale = {0.2, 0.1, 0.3}, .Quat = {0, 0, 0, 0}, .Opacity = 0.4},
      {.Scale = {0.2, 0.1, 0.3}, .Quat = {1e38F, 2e37F, 0, 0}, .Opacity = 1},
      {.Scale = {0.2, 0.1, 0.3}, .Quat = {1e-38F, 1e-38F, 0, 0}}};
  for (const Blob &B : Seen) {
    Blob To = B;
    To.Color = R.color();
    add(C.Scene, To);
  }
  const auto Never = [&](const Blob &B, std::string_view Reason) {
    C.LeftOut.push_back(static_cast<uint32_t>(C.Scene.size()));
    ++culledAs(C, Reason);
    add(C.Scene, B);
  };
  Never({.Mean = {0, 0, 0}}, "near");
  Never({.Mean = {0, 0, -2}, .Scale = {9, 9, 9}}, "near");
  Never({.Mean = {0, 0, 2}, .Opacity = 0.003}, "faint");
  Never({.Mean = {NAN, 0, 2}}, "non_finite");
  Never({.Mean = {1e3F, 0, 2}}, "outside");
  Never({.Mean = {1e30F, 1e30F, 2}}, "non_finite");
  Never({.Mean = {3e38F, 3e38F, 3e38F}}, "non_finite");
  return C;
}

} // namespace

void addRays(std::vector<TrainingCase> &Cases) {
  const std::string Inside = "rays begin inside of wide Gaussians, of which "
                             "some are densest behind them";
  const std::string End = "needles of 25:1 that rays see end-on and nearly so";
  const std::string Flat =
      "one scale of 0 is a disc; lines and points are met by no ray";
  const std::string One = "20 with one centre, of which the file's order holds";
  Cases.push_back(pictureOf("rays-from-inside", Inside, fromInside(),
                            {"rays-without-near"}));
  Cases.push_back(pictureOf("rays-along-needles", End, alongNeedles(false)));
  Cases.push_back(
      pictureOf("parallel-rays-along-needles", End, alongNeedles(true)));
  Cases.push_back(pictureOf("rays-of-discs", Flat, withoutThickness()));
  Cases.push_back(pictureOf("rays-in-a-disc",
                            "rays lie in a disc of no thickness",
                            inTheDisc(false)));
  Cases.push_back(pictureOf("parallel-rays-in-a-disc",
                            "rays lie in a disc of no thickness",
                            inTheDisc(true)));
  Cases.push_back(pictureOf("rays-through-one-centre", One, coincident()));
  Cases.push_back(pictureOf("rays-of-extremes",
                            "scales up to 1e19, depths up to 1e6, quaternions "
                            "of any length beside what is culled, NaN too",
                            extremes()));
  const std::string Fourth = "densities of exp(-q^2 / 18): ";
  Cases.push_back(pictureOf("degree-4-from-inside", Fourth + Inside,
                            ofDegree4(fromInside())));
  Cases.push_back(pictureOf("degree-4-along-needles", Fourth + End,
                            ofDegree4(alongNeedles(false)),
                            {"degree-4-in-small-boxes"}));
  Cases.push_back(pictureOf("degree-4-of-discs", Fourth + Flat,
                            ofDegree4(withoutThickness())));
  Cases.push_back(gradientsOf("degree-4-from-inside", Fourth + Inside,
                              ofDegree4(fromInside()), {"degree-4-back-as-2"}));
  Cases.push_back(gradientsOf("degree-4-along-needles", Fourth + End,
                              ofDegree4(alongNeedles(false))));
  const std::string Edge =
      "surfels from the edge, to the bit and nearly, and less than a pixel";
  Cases.push_back(pictureOf("surfels-from-the-edge", Edge, edges(false),
                            {"surfels-without-low-pass"}));
  Cases.push_back(
      pictureOf("parallel-surfels-from-the-edge", Edge, edges(true)));
  Cases.push_back(pictureOf("surfels-behind-rays",
                            "rays that begin behind the discs' planes",
                            surfels(fromInside())));
  Cases.push_back(
      pictureOf("surfels-with-one-centre", One, surfels(coincident())));
  Cases.push_back(gradientsOf("surfels-from-the-edge", Edge, edges(false, 32)));
  Cases.push_back(
      gradientsOf("parallel-surfels-from-the-edge", Edge, edges(true)));
  Cases.push_back(gradientsOf("surfels-behind-rays",
                              "rays that begin behind the discs' planes",
                              surfels(fromInside()), {"surfels-back-by-rays"}));
  Cases.push_back(gradientsOf("rays-from-inside", Inside, fromInside(),
                              {"rays-back-by-plane"}));
  Cases.push_back(gradientsOf("rays-along-needles", End, alongNeedles(false)));
  Cases.push_back(
      gradientsOf("parallel-rays-along-needles", End, alongNeedles(true)));
  Cases.push_back(gradientsOf("rays-of-discs", Flat, withoutThickness()));
  Cases.push_back(gradientsOf("rays-through-one-centre", One, coincident()));
}

} // namespace vorion::test
