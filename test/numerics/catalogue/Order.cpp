// What the order of Gaussians does: centres that change places as a camera
// turns, and pixels that blend by the depths along their own rays.
#include "Build.h"
#include "Convert.h"
#include "Judge.h"
#include "TrainingCase.h"

#include "picture/View.h"
#include "reference/PixelOrder.h"
#include "reference/Projection.h"
#include "render/Renderer.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace vorion::test {
namespace {

/// Pairs of discs that lie side by side: a camera at the origin that turns by
/// \p Angle about the vertical gives each pair the other order than one that
/// turns by -\p Angle. Their distances from the camera stay what they are.
HardCase popping(const char *Name, double Angle) {
  HardCase C{Name,
             "a camera turns, and neighbours change places in the order of "
             "depths, though not in that of distances",
             {},
             frontView(64, 48, 50),
             {}};
  C.View.Rotation = {{{std::cos(Angle), 0, std::sin(Angle)},
                      {0, 1, 0},
                      {-std::sin(Angle), 0, std::cos(Angle)}}};
  Numbers R(91);
  for (int I = 0; I < 24; ++I) {
    const double X = R.uniform(-0.8, 0.8), Y = R.uniform(-0.7, 0.7);
    const double Z = 2 + 0.1 * I;
    for (const double Side : {-0.1, 0.1})
      add(C.Scene,
          {.Mean = {static_cast<float>(X + Side), static_cast<float>(Y),
                    static_cast<float>(Z + 0.02 * Side)},
           .Scale = {0.15, 0.15, 0.15},
           .Opacity = 0.9,
           .Color = R.color()});
  }
  C.FoundIn = {"ordered-by-distance"};
  return C;
}

/// A scene whose pixels blend by the depths along their own rays.
struct RayScene {
  splat::Scene Scene;
  splat::Camera View;
};

/// Whether two Gaussians that the pixel blends are so close along its ray that
/// fp32 may see them the other way round.
bool isClose(const std::vector<reference::Splat<double>> &Splats,
             const reference::PixelDepth &Depth, int X, int Y) {
  std::vector<double> Depths;
  for (std::size_t I = 0; I < Splats.size(); ++I)
    if (Splats[I].Visible)
      Depths.push_back(Depth(I, X, Y));
  std::ranges::sort(Depths);
  return std::ranges::adjacent_find(Depths, [](double A, double B) {
           return B - A < 1e-5 * std::abs(B);
         }) != Depths.end();
}

constexpr double RayBound = 1e-5;

/// Against the reference in fp64, which sorts all that a pixel blends.
Expected<Finding> judgeRays(splat::Launcher &L, splat::Path P,
                            const RayScene &S) {
  splat::RenderOptions O;
  O.Blending = P;
  O.Order = splat::PixelOrder::Ray;
  const splat::ViewFacts Facts =
      splat::factsOf(S.Scene, splat::makeView(S.View, O), O);
  const auto R = splat::render(
      L, splat::planRender(splat::EffectPlan({}, {S.Scene, O, Facts}), O),
      S.Scene, S.View, O, /*KeepPairs=*/false);
  if (!R)
    return R.error();

  const reference::Options Rules = referenceOptions(O);
  const auto G = splat::toReference<double>(S.Scene);
  const auto View = splat::toReference<double>(S.View);
  const auto Splats = reference::project(G, View, Rules);
  const auto Doubts =
      reference::blend(Splats, View.Width, View.Height, Rules).Doubts;
  const auto Depth = reference::depthAlongRay(G, View);
  const auto Want =
      reference::blendInOrder(Splats, View.Width, View.Height, Rules, Depth);
  Finding F;
  F.Bound = RayBound;
  std::size_t Judged = 0;
  for (std::size_t I = 0; I < Doubts.size(); ++I) {
    const auto Width = static_cast<std::size_t>(View.Width);
    if ((Doubts[I] & ~reference::DoubtOrder) != 0 ||
        isClose(Splats, Depth, static_cast<int>(I % Width),
                static_cast<int>(I / Width)))
      continue;
    ++Judged;
    for (std::size_t K = 0; K < 3; ++K) {
      const double Error = std::abs(double(R->Picture.Render[3 * I + K]) -
                                    Want.Render[I][static_cast<int>(K)]);
      if (!(Error <= F.Error))
        F.Error = Error;
    }
  }
  if (!(F.Error <= RayBound))
    F.Broken =
        fmt::format("error {:.3g}, expected at most {:.3g}", F.Error, RayBound);
  else if (Judged < Doubts.size() / 2)
    F.Broken = fmt::format("{} of {} pixels are certain, expected half", Judged,
                           Doubts.size());
  else if (Want.Turned == 0)
    F.Broken = "no pair has another order along its ray, expected some";
  return F;
}

TrainingCase byRay(std::string Name, std::string Why, RayScene S,
                   std::vector<std::string> FoundIn) {
  return {std::move(Name),
          std::move(Why),
          fmt::format("{:.0e} of fp64, sorted along the ray", RayBound),
          [Shared = std::make_shared<RayScene>(std::move(S))](
              splat::Launcher &L, const Way &W) {
            return judgeRays(L, W.Blending, *Shared);
          },
          std::move(FoundIn),
          /*Blends=*/true,
          splat::Path::Simt};
}

TrainingCase crossingSheets() {
  RayScene S{{}, frontView(64, 48, 50)};
  const double Half = 0.5 * std::atan(0.5); // a slope of 1/2
  for (const double Side : {-1., 1.})
    add(S.Scene, {.Mean = {0, static_cast<float>(0.01 * Side), 3},
                  .Scale = {0.6, 0.4, 0.002},
                  .Quat = {static_cast<float>(std::cos(Half)), 0,
                           static_cast<float>(Side * std::sin(Half)), 0},
                  .Opacity = 0.8,
                  .Color = {0.5 + 0.4 * Side, 0.4, 0.5 - 0.4 * Side}});
  return byRay("order-along-rays-crossing",
               "two sheets cross: each is in front where it is nearer, though "
               "their centres have one depth",
               std::move(S), {"rays-see-centres"});
}

/// \p Count sheets, each nearer along the middle's rays than those before it
/// in the order of centres.
TrainingCase reversed(int Count, const char *Name, const char *Why,
                      std::vector<std::string> FoundIn) {
  RayScene S{{}, frontView(32, 24, 50)};
  const double Slope = 1;
  const double Half = 0.5 * std::atan(Slope);
  Numbers R(92);
  for (int I = 0; I < Count; ++I) {
    // Beside the picture's middle by so much that a sheet with this slope
    // passes the axis at the depth of 4 - 0.02 I.
    const double Centre = 3 + 0.01 * I;
    const double At = 4 - 0.02 * I;
    add(S.Scene, {.Mean = {static_cast<float>((Centre - At) / -Slope), 0,
                           static_cast<float>(Centre)},
                  .Scale = {1.5, 1.5, 0.001},
                  .Quat = {static_cast<float>(std::cos(Half)), 0,
                           static_cast<float>(std::sin(Half)), 0},
                  .Opacity = 0.1,
                  .Color = R.color()});
  }
  return byRay(Name, Why, std::move(S), std::move(FoundIn));
}

} // namespace

void addOrders(std::vector<HardCase> &Cases) {
  Cases.push_back(popping("popping-before", -0.1));
  Cases.push_back(popping("popping-after", 0.1));
}

void addRayOrders(std::vector<TrainingCase> &Cases) {
  Cases.push_back(crossingSheets());
  Cases.push_back(reversed(16, "order-along-rays-window-full",
                           "16 sheets in the reverse order of their centres: "
                           "as many as a pixel's window holds",
                           {"rays-see-centres"}));
  Cases.push_back(reversed(35, "order-along-rays-three-windows",
                           "35 sheets in the reverse order: a pixel goes "
                           "through its list three times",
                           {"rays-see-centres", "ray-window-once"}));
}

} // namespace vorion::test
