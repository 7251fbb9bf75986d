// Scenes whose gradients are hard: culled neighbours, hand-overs that are just
// full, deep stacks.
#include "Build.h"
#include "GradientJudge.h"
#include "Lenses.h"
#include "Places.h"
#include "lens/Lenses.h"

#include <cmath>
#include <fmt/format.h>
#include <map>
#include <memory>

namespace vorion::test {
namespace {

/// docs/numerics.md, "Gradients".
constexpr double Allowed = 1e-5;

TrainingCase caseOf(std::string Name, std::string Why, GradientScene S,
                    std::vector<std::string> FoundIn) {
  return {std::move(Name),
          std::move(Why),
          fmt::format("{:.0e} of the fp64 gradients{}{}", Allowed,
                      S.Culled.empty() ? "" : ", culled ones 0",
                      !S.Silent          ? ""
                      : S.Culled.empty() ? ", no opacity's 0"
                                         : ", no other opacity's"),
          [Shared = std::make_shared<GradientScene>(std::move(S))](
              splat::Launcher &L, const Way &W) {
            return judgeGradients(L, W, *Shared, Allowed);
          },
          std::move(FoundIn),
          /*Blends=*/true,
          {},
          /*GoesBack=*/true};
}

/// Something to be seen beside what a case is about.
void addBlob(splat::Scene &S, Numbers &R, float X, float Y) {
  add(S, {.Mean = {X, Y, static_cast<float>(R.uniform(1.9, 2.1))},
          .Scale = {0.06, 0.1, 0.08},
          .Quat = R.turn(),
          .Opacity = R.uniform(0.3, 0.9),
          .Color = R.color()});
}

TrainingCase culled() {
  GradientScene G{{}, frontView(70, 50, 50), {}};
  Numbers R(51);
  const Blob Unseen[] = {
      {.Mean = {0, 0, 0.1F}},                           // near
      {.Mean = {0, 0, 0}},                              // at the camera
      {.Mean = {0.2F, 0, -2}, .Scale = {9, 9, 9}},      // behind
      {.Mean = {40, 0, 2}},                             // outside
      {.Mean = {0, 0.1F, 2}, .Opacity = 0.0035},        // faint
      {.Mean = {0, 0, 2}, .Scale = {1e30, 1e30, 1e30}}, // beyond fp32
      {.Mean = {1e38F, 1e38F, 2}}};
  for (const Blob &B : Unseen) {
    addBlob(G.Scene, R, static_cast<float>(R.uniform(-0.8, 0.8)),
            static_cast<float>(R.uniform(-0.6, 0.6)));
    G.Culled.push_back(static_cast<uint32_t>(G.Scene.size()));
    add(G.Scene, B);
  }
  return caseOf("gradients-of-culled",
                "near, behind, outside, faint and beyond fp32 beside what is "
                "seen: 0 exactly, though their z divides by 0",
                std::move(G), {"culled-go-back"});
}

TrainingCase nothingSeen() {
  GradientScene G{{}, frontView(70, 50, 50), {}, {0, 1}};
  add(G.Scene, {.Mean = {0, 0, -2}});
  add(G.Scene, {.Mean = {0, 0, 2}, .Opacity = 0.001});
  return caseOf("gradients-of-nothing",
                "no Gaussian is seen: lists of 0, nothing to add up",
                std::move(G), {});
}

/// Lists of \p Length Gaussians in neighbouring tiles of either path.
TrainingCase handOver(unsigned Length) {
  GradientScene G{{}, frontView(128, 16, 50), {}};
  Numbers R(60 + Length);
  for (int Tile = 0; Tile < 4; ++Tile)
    for (unsigned I = 0; I < Length; ++I) {
      const double Column = 32 * Tile + 8 + R.uniform(-3, 3);
      add(G.Scene, {.Mean = {static_cast<float>((Column - 64) / 25),
                             static_cast<float>(R.uniform(-0.12, 0.12)),
                             static_cast<float>(2 + 0.001 * I)},
                    .Scale = {0.03, 0.02, 0.02},
                    .Quat = R.turn(),
                    .Opacity = 0.15,
                    .Color = R.color()});
    }
  std::vector<std::string> FoundIn;
  if (Length >= 16)
    FoundIn.emplace_back("sixteenth-lost");
  if (Length > 16)
    FoundIn.emplace_back("seventeenth-lost");
  if (Length > 64)
    FoundIn.emplace_back("second-batch-lost");
  return caseOf(fmt::format("hand-over-{}", Length),
                Length < 64 ? "16 Gaussians are handed over together: one "
                              "less, just full, one more, two full"
                            : "sums by atomics have batches of 64: just full, "
                              "one more",
                std::move(G), std::move(FoundIn));
}

/// Each over the whole picture, so that all cores add to its sums at once, and
/// what the pixels have nearly cancels.
TrainingCase overAllTiles() {
  GradientScene G{{}, frontView(160, 96, 50), {}};
  Numbers R(57);
  for (int I = 0; I < 20; ++I)
    add(G.Scene, {.Mean = {static_cast<float>(R.uniform(-0.5, 0.5)),
                           static_cast<float>(R.uniform(-0.3, 0.3)),
                           static_cast<float>(2 + 0.1 * I)},
                  .Scale = {3, 2, 1},
                  .Quat = R.turn(),
                  .Opacity = R.uniform(0.05, 0.2),
                  .Color = R.color()});
  TrainingCase C =
      caseOf("sums-over-all-tiles",
             "every core adds to the sums of each Gaussian, and what the "
             "pixels have nearly cancels",
             std::move(G), {"atomic-once", "last-lane-lost", "warp-wants-all"});
  C.Contract += ", whatever the order of sums; that of atomics is the cores' "
                "and lanes', for any number of host threads";
  return C;
}

TrainingCase deepStack() {
  GradientScene G{{}, frontView(18, 16, 50), {}};
  // Transmittance on the way back is a product of thousands of quotients; that
  // of rounded reciprocals would drift, and rise above 1.
  G.Options.Cutoff = 0;
  Numbers R(52);
  for (int I = 0; I < 4000; ++I)
    add(G.Scene, {.Mean = {0, 0, static_cast<float>(2 + 0.0005 * I)},
                  .Scale = {40, 40, 40},
                  .Opacity = 0.0045,
                  .Color = R.color()});
  return caseOf("transmittance-back-through-4000",
                "4,000 layers of one alpha: a rounded reciprocal makes the "
                "same error in each, and T rises above 1",
                std::move(G), {"reciprocal-rounded"});
}

/// Turned needles whose quaternions have the length \p Length.
TrainingCase shortQuaternions(float Length, std::string Name) {
  GradientScene G{{}, frontView(70, 50, 50), {}};
  Numbers R(53);
  for (int I = 0; I < 12; ++I) {
    addBlob(G.Scene, R, static_cast<float>(R.uniform(-0.8, 0.8)),
            static_cast<float>(R.uniform(-0.6, 0.6)));
    for (std::size_t K = 0; K < 4; ++K)
      *(G.Scene.Quats.end() - 1 - static_cast<std::ptrdiff_t>(K)) *= Length;
  }
  return caseOf(std::move(Name),
                "the gradient grows as the quaternion shrinks, up to that of a "
                "length of 2^-103: fp32 holds no more",
                std::move(G),
                Length < 0x1p-103F
                    ? std::vector<std::string>{"quaternion-gradient-unbounded"}
                    : std::vector<std::string>{});
}

/// What others' trackers have as causes of gradients that are no numbers, all
/// seen, with the opacity compensated.
TrainingCase causesOfNaN(bool Gsplat) {
  GradientScene G{{}, frontView(70, 50, 50), {}};
  G.Options.Antialiased = true;
  if (Gsplat)
    G.Options.Convention = splat::Rules::Gsplat;
  Numbers R(54);
  const float X = -0.5F / 50, Y = -0.5F / 50; // a pixel's centre at depth 1
  const Blob Causes[] = {
      {.Mean = {0.5F, 0.3F, 2}, .Quat = {0, 0, 0, 0}},    // no direction
      {.Mean = {X, Y, 1}, .Scale = {0.01, 0.01, 0.01}},   // a distance of 0
      {.Mean = {-0.3F, 0.2F, 2}, .Opacity = 1},           // 1 - opacity is 0
      {.Mean = {0.3F, -0.4F, 2}, .Scale = {0.1, 0.1, 0}}, // a disc
      {.Mean = {-0.5F, -0.4F, 2}, .Scale = {0.4, 0, 0}},  // a line
      {.Mean = {0, 0, 3}, .Scale = {1e6, 1e6, 1e6}},      // over everything
      {.Mean = {0, 0.4F, 2},
       .Scale = {0.05, 0.1, 0.2},
       .Quat = {1e-12F, 2e-12F, 1e-12F, 0}},
      {.Mean = {0.2F, 0.1F, 2}, .Color = {-3, -3, -3}}, // held at 0
      {.Mean = {0, 0, 0.2000001F}, .Scale = {1e-4, 1e-4, 1e-4}}};
  for (const Blob &B : Causes) {
    addBlob(G.Scene, R, static_cast<float>(R.uniform(-0.8, 0.8)),
            static_cast<float>(R.uniform(-0.6, 0.6)));
    add(G.Scene, B);
  }
  return caseOf(Gsplat ? "causes-of-nan-gsplat" : "causes-of-nan",
                "quaternion 0, scales 0, opacity 1, a mean on a pixel's "
                "centre, a disc from its edge, colours held at 0",
                std::move(G), {});
}

/// 0.03 to 3 px wide, as a reset of opacities leaves them. The dilation makes
/// each at least 0.548 px wide, so that it reaches a pixel's centre. Where
/// opacities are compensated, a narrow one has an alpha below 1/255 everywhere,
/// and nothing ever brings it back.
TrainingCase reset(bool Antialiased) {
  GradientScene G{{}, frontView(120, 80, 50), {}};
  G.Options.Antialiased = Antialiased;
  G.Silent = 0;
  Numbers R(55);
  for (int I = 0; I < 60; ++I) {
    const double Pixels = 0.03 * std::pow(100, I / 59.);
    const int Column = I % 10, Row = I / 10;
    // Off pixels' centres by all that there is.
    const double X = 12 * Column - 54 + R.uniform(-0.5, 0.5);
    const double Y = 12 * Row - 30 + R.uniform(-0.5, 0.5);
    // What the dilation of 0.3 leaves of the opacity.
    if (Antialiased && Pixels * Pixels / (Pixels * Pixels + 0.3) < 1 / 2.55)
      G.Culled.push_back(static_cast<uint32_t>(G.Scene.size()));
    add(G.Scene,
        {.Mean = {static_cast<float>(X / 25), static_cast<float>(Y / 25), 2},
         .Scale = {Pixels / 25, Pixels / 25, Pixels / 25},
         .Opacity = 0.01,
         .Color = R.color()});
  }
  // One behind all, so that no list ends with a narrow one.
  add(G.Scene, {.Mean = {0, 0, 3}, .Scale = {5, 5, 5}, .Opacity = 0.01});
  return caseOf(
      Antialiased ? "opacities-reset-antialiased" : "opacities-reset",
      Antialiased
          ? "opacities of 0.01, compensated: what is below 1/255 in every "
            "fragment has no gradient, and never comes back"
          : "opacities of 0.01: all that lie in the picture have a gradient, "
            "wherever their pixels' centres are",
      std::move(G), {"faint-come-back"});
}

/// Gaussians, a stack that is full, and nothing, before a colour.
TrainingCase overBackground() {
  GradientScene G{{}, frontView(70, 50, 50), {}};
  G.Options.Background = {1, 0.25F, 0};
  Numbers R(56);
  for (int I = 0; I < 12; ++I)
    addBlob(G.Scene, R, static_cast<float>(R.uniform(-1, 0)),
            static_cast<float>(R.uniform(-0.6, 0.6)));
  for (int I = 0; I < 8; ++I)
    add(G.Scene, {.Mean = {0.7F, 0, static_cast<float>(2 + 0.05 * I)},
                  .Scale = {0.2, 0.2, 0.2},
                  .Opacity = 0.99,
                  .Color = R.color()});
  return caseOf("gradients-over-a-background",
                "what is in front of a colour takes it away; behind a full "
                "stack it is not seen",
                std::move(G), {"background-lost"});
}

/// Each camera with coefficients of its own, in all directions.
GradientScene sceneOfLens(const splat::LensModel *M) {
  GradientScene G{{}, lensView(M, someCoefficients(M), 96, 64), {}};
  const splat::Scene All = allAround(140, 81);
  for (uint32_t I = 0; I < All.size(); ++I) {
    const float *P = &All.Means[3 * I];
    const bool Everywhere = M == &splat::lenses::Equirectangular;
    if (Everywhere || (P[2] > 1 && std::hypot(P[0], P[1]) < 0.5 * P[2]))
      append(G.Scene, All, I, 1);
  }
  G.Options.Optics = M;
  return G;
}

/// One for each model but the pinhole, also for those that are added later.
void addThroughLenses(std::vector<TrainingCase> &Cases) {
  namespace lenses = splat::lenses;
  const std::map<const splat::LensModel *, std::string> Why{
      {&lenses::OpenCv, "back through all twelve coefficients and the "
                        "Jacobian's own derivative"},
      {&lenses::Division, "back through a quotient by a square root"},
      {&lenses::Eucm,
       "back through a quotient by a square root plus the depth"},
      {&lenses::Fisheye, "back through the angle's polynomial, where "
                         "differences of nearly equal terms cancel"},
      {&lenses::Orthographic, "depth moves nothing on the picture"},
      {&lenses::Equirectangular, "a Gaussian on both sides of the seam has the "
                                 "sum of both gradients"}};
  for (const splat::LensModel *M : lenses::all())
    if (!M->isPinhole())
      Cases.push_back(caseOf(
          fmt::format("gradients-through-{}", M->EffectName),
          Why.contains(M) ? Why.at(M)
                          : fmt::format("back through {}", M->EffectText),
          sceneOfLens(M), {}));
}

/// Wide Gaussians, one far beside the picture, where a pinhole's Jacobian is
/// held.
void addWide(GradientScene &G) {
  Numbers R(86);
  for (const float X : {-0.3F, 0.2F, 2.8F})
    add(G.Scene, {.Mean = {X, 0.1F, 2},
                  .Scale = {0.3, 0.2, 1.6},
                  .Quat = R.turn(),
                  .Opacity = 0.3,
                  .Color = R.color()});
}

/// It rolls down and across while the camera moves and turns.
void addShutter(GradientScene &G) {
  G.Options.Rolling = true;
  G.View.Optics.Shutter = {-0.1, 0.2, 1, {0.1, -0.15, 0.05}, {0.05, -0.1, 0.1}};
}

/// By the Jacobian, whose rows depend on the mean's moment.
TrainingCase throughShutter(const splat::LensModel *M, splat::Rules Convention,
                            std::string Name, std::string Why) {
  GradientScene G = sceneOfLens(M);
  addWide(G);
  addShutter(G);
  G.Options.Antialiased = true;
  G.Options.Convention = Convention;
  return caseOf(std::move(Name), std::move(Why), std::move(G),
                {"moment-forgotten-behind", "rows-of-a-shutter-kept"});
}

/// As seven points. Of the wide Gaussians the camera does not see some, so that
/// these go back through the Jacobian, one of them where it is held. With \p
/// Rolls a shutter rolls.
TrainingCase throughPoints(const splat::LensModel *M, bool Rolls,
                           std::string Name, std::string Why) {
  GradientScene G = sceneOfLens(M);
  addWide(G);
  G.Options.Through = splat::Spread::Unscented;
  G.Options.Antialiased = !Rolls;
  if (Rolls)
    addShutter(G);
  std::vector<std::string> FoundIn{"points-forget-their-shift"};
  if (M == &splat::lenses::Pinhole)
    FoundIn.emplace_back("held-slope-of-no-depth");
  if (Rolls)
    FoundIn.emplace_back("shear-forgotten-behind");
  return caseOf(std::move(Name), std::move(Why), std::move(G),
                std::move(FoundIn));
}

/// Thinner than a pixel, so that the shutter's shear of the dilation counts.
TrainingCase rollingDilation(splat::Spread Through, std::string Name,
                             std::string FoundIn) {
  GradientScene G{{}, lensView(&splat::lenses::Pinhole, {}, 96, 64), {}};
  G.View.Optics.Shutter = {0, 0.1, 1, {0.1, 0, 0.2}, {-0.3, 0.3, 0.2}};
  Numbers R(89);
  for (int I = 0; I < 30; ++I)
    add(G.Scene,
        {.Mean = {float(R.uniform(-0.5, 0.5)), float(R.uniform(-0.4, 0.4)),
                  float(R.uniform(1.5, 2.5))},
         .Scale = {R.uniform(0.003, 0.02), R.uniform(0.003, 0.02),
                   R.uniform(0.003, 0.02)},
         .Quat = R.turn(),
         .Opacity = 0.8,
         .Color = R.color()});
  G.Options.Through = Through;
  G.Options.Antialiased = true;
  G.Options.Rolling = true;
  return caseOf(std::move(Name),
                "thinner than a pixel behind a shutter, antialiased: the "
                "dilation's shear and what it keeps of the opacity move with "
                "the mean",
                std::move(G), {std::move(FoundIn)});
}

/// One of each one's points is just in front of the near plane and far beside
/// the picture, so that it goes back through the Jacobian, as it came.
TrainingCase pointsBeside() {
  GradientScene G = sceneOfLens(&splat::lenses::Pinhole);
  Numbers R(87);
  for (const auto &[X, Y, Z] :
       {std::array{2.0F, 0.3F, 1.2F}, {-2.4F, -0.6F, 1.5F}})
    add(G.Scene, {.Mean = {X, Y, Z},
                  .Scale = {0.4, 0.5, (Z - 0.25) / std::sqrt(3.)},
                  .Opacity = 0.5,
                  .Color = R.color()});
  G.Options.Through = splat::Spread::Unscented;
  return caseOf("gradients-beside-points",
                "large Gaussians beside a pinhole's picture, with a point just "
                "in front of the near plane",
                std::move(G), {"points-anywhere"});
}

TrainingCase needlesAt(const splat::LensModel *M, std::string Name,
                       std::string Why) {
  const splat::Camera View = needleView(M);
  GradientScene G{pointingNeedles(View, 85), View, {}};
  G.Options.Optics = M;
  return caseOf(std::move(Name), std::move(Why), std::move(G),
                {"needles-by-plain-sums"});
}

TrainingCase smallOn(std::string Name, std::string Why,
                     const splat::Camera &View,
                     std::vector<std::string> FoundIn) {
  GradientScene G{smallOnPicture(View, 80, 91), View, {}};
  G.Options.Optics = View.Optics.Model;
  return caseOf(std::move(Name), std::move(Why), std::move(G),
                std::move(FoundIn));
}

} // namespace

void addGradients(std::vector<TrainingCase> &Cases) {
  Cases.push_back(culled());
  Cases.push_back(nothingSeen());
  for (const unsigned Length : {15U, 16U, 17U, 32U, 33U, 64U, 65U})
    Cases.push_back(handOver(Length));
  Cases.push_back(overAllTiles());
  Cases.push_back(deepStack());
  Cases.push_back(shortQuaternions(1e-12F, "gradients-of-quaternions-1e-12"));
  Cases.push_back(shortQuaternions(1e-20F, "gradients-of-quaternions-1e-20"));
  Cases.push_back(shortQuaternions(1e-30F, "gradients-of-quaternions-1e-30"));
  Cases.push_back(shortQuaternions(1e-40F, "gradients-of-quaternions-1e-40"));
  Cases.push_back(causesOfNaN(/*Gsplat=*/false));
  Cases.push_back(causesOfNaN(/*Gsplat=*/true));
  Cases.push_back(reset(/*Antialiased=*/false));
  Cases.push_back(reset(/*Antialiased=*/true));
  Cases.push_back(overBackground());
  namespace lenses = splat::lenses;
  addThroughLenses(Cases);
  Cases.push_back(throughPoints(&lenses::Pinhole, /*Rolls=*/false,
                                "gradients-through-points",
                                "back through seven points of each, "
                                "antialiased"));
  Cases.push_back(throughPoints(&lenses::OpenCv, /*Rolls=*/false,
                                "gradients-through-points-opencv",
                                "the same through all coefficients"));
  Cases.push_back(throughPoints(&lenses::Equirectangular, /*Rolls=*/false,
                                "gradients-through-points-equirectangular",
                                "the same with points on both sides of the "
                                "seam"));
  Cases.push_back(throughPoints(&lenses::Fisheye, /*Rolls=*/true,
                                "gradients-through-points-rolling",
                                "each point at a moment of its own, which its "
                                "place moves"));
  using splat::Spread;
  Cases.push_back(rollingDilation(Spread::Unscented,
                                  "gradients-of-rolling-dilation",
                                  "shear-forgotten-behind"));
  Cases.push_back(rollingDilation(Spread::Jacobian,
                                  "gradients-of-rolling-dilation-jacobian",
                                  "moment-forgotten-behind"));
  using splat::Rules;
  Cases.push_back(throughShutter(&lenses::Pinhole, Rules::Inria,
                                 "gradients-through-shutter",
                                 "the rows at a mean's own moment, and the "
                                 "moment, move with the mean; one is held"));
  Cases.push_back(throughShutter(&lenses::Pinhole, Rules::Gsplat,
                                 "gradients-through-shutter-gsplat",
                                 "the same where the limit moves with the "
                                 "mean"));
  Cases.push_back(throughShutter(&lenses::OpenCv, Rules::Gsplat,
                                 "gradients-through-shutter-opencv",
                                 "the same through all coefficients"));
  Cases.push_back(throughShutter(&lenses::Fisheye, Rules::Inria,
                                 "gradients-through-shutter-fisheye",
                                 "the same through a fisheye"));
  Cases.push_back(throughShutter(&lenses::Equirectangular, Rules::Inria,
                                 "gradients-through-shutter-equirectangular",
                                 "the same on a full sphere"));
  Cases.push_back(pointsBeside());
  Cases.push_back(needlesAt(&splat::lenses::Pinhole,
                            "gradients-of-needles-ahead",
                            "needles of 1,000 to 6,000 px that point at the "
                            "camera"));
  Cases.push_back(needlesAt(&splat::lenses::Fisheye,
                            "gradients-of-needles-at-a-fisheye",
                            "the same at a fisheye"));
  Cases.push_back(smallOn("gradients-through-a-long-lens",
                          "a focal length of 400,000 px", longView(),
                          {"crop-by-plain-sum"}));
  Cases.push_back(smallOn("gradients-of-a-wide-picture",
                          "16,384 px wide, the principal point beside its "
                          "middle",
                          wideView(), {"windows-by-plain-places"}));
}

} // namespace vorion::test
