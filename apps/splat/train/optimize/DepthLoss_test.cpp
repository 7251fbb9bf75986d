// Depths that are known: from a capture's points to gradients and to a scene.
#include "train/data/DepthPoints.h"

#include "analyze/ToReference.h"
#include "device/OnDevice.h"
#include "reference/Render.h"
#include "train/optimize/DeviceRenderer.h"
#include "train/run/Trainer.h"
#include "train/testing/SmallScenes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorion::splat {
namespace {

TEST(DepthPoints, AreThoseThatAPictureShows) {
  const Camera C = Camera::ahead(8, 6, 10);
  constexpr float None = std::numeric_limits<float>::quiet_NaN();
  const CapturePoints P{{0,    0,  2,  // (4, 3)
                         0.5F, 0,  4,  // (5.25, 3)
                         0,    0,  -2, // behind
                         9,    0,  2,  // beside
                         0,    0,  0,  // in the camera
                         None, 0,  2,  //
                         0,    -1, 4,  // (4, 0.5)
                         0,    0,  8,  // (4, 3) again
                         0,    0,  1}, // not in the track
                        std::vector<uint8_t>(27, 0)};
  const std::vector<uint32_t> Sees{0, 1, 2, 3, 4, 5, 6, 7};
  const std::vector<DepthPoint> All{
      {4, 0.25F}, {28, 0.125F}, {28, 0.5F}, {29, 0.25F}};
  EXPECT_EQ(depthPoints(C, P.local(), Sees, {}), All);
  std::vector<uint8_t> Counts(48, 1);
  Counts[28] = 0;
  EXPECT_EQ(depthPoints(C, P.local(), Sees, Counts),
            (std::vector<DepthPoint>{{4, 0.25F}, {29, 0.25F}}));
  EXPECT_TRUE(depthPoints(C, P.local(), {}, {}).empty());
}

class DepthLossOnDevice
    : public OnDevice,
      public testing::WithParamInterface<std::tuple<Rules, Path>> {
protected:
  static Camera camera() {
    return aroundOrigin(Camera::ahead(40, 26, 35), 0.3, 0.1);
  }

  /// Blended with (depth, 1, 0) for colours.
  static reference::Picture<double>
  depths(const reference::Gaussians<double> &G, const Camera &C,
         const reference::Options &O) {
    auto Splats = reference::project(G, toReference<double>(C), O);
    for (auto &S : Splats)
      S.Color = {S.Depth, 1, 0};
    return reference::blend(Splats, C.Width, C.Height, O);
  }

  static double loss(const reference::Picture<double> &P,
                     const std::vector<DepthPoint> &Known) {
    double Sum = 0;
    for (const DepthPoint &K : Known)
      if (const glm::dvec3 &V = P.Render[K.Pixel]; V.y > 0)
        Sum += std::abs(V.y / V.x - double{K.Disparity});
    return Sum;
  }
};

/// Central differences in fp64 of the loss of known depths, by every stored
/// parameter. Among the pixels are one of two points and one that shows
/// nothing.
TEST_P(DepthLossOnDevice, GradientsAreThoseOfTheLoss) {
  const auto [Convention, Blending] = GetParam();
  reference::Options O;
  O.Rule = toReference(Convention);
  const Scene S = randomScene(Random, 24, 1);
  const Camera C = camera();
  const auto G = toReference<double>(S);
  const auto Shown = depths(G, C, O);
  std::vector<DepthPoint> Known{{0, 0.3F}};
  ASSERT_EQ(Shown.Render[0].y, 0);
  for (uint32_t P = 200; P < Shown.Render.size(); P += 37)
    if (const glm::dvec3 &V = Shown.Render[P];
        Shown.Doubts[P] == 0 && V.y > 0.05)
      Known.push_back(
          {P, static_cast<float>((P % 2 == 0 ? 1.2 : 0.7) * V.y / V.x)});
  ASSERT_GT(Known.size(), 10U);
  Known.push_back(Known.back());
  Known.back().Disparity *= 0.5F;

  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  BackwardOptions Options;
  Options.Depths = true;
  DeviceRenderer R(L, Convention, Blending, Options, {});
  DeviceScene D = DeviceScene::upload(L, S);
  R.forward(D, C, 1);
  const auto Nothing =
      upload(L, std::vector<float>(3 * Shown.Render.size(), 0));
  constexpr float Weight = 0.75F;
  D.Parameters = R.backward(Nothing, Nothing, {&Known, Weight}).Gradients;
  const Scene Got = D.download(L);
  ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
  EXPECT_EQ(std::ranges::count(Got.Sh, 0), std::ssize(Got.Sh));

  constexpr double Step = 1e-6;
  const auto Slope = [&](auto Move) {
    double Sides[2];
    for (const int Side : {0, 1}) {
      auto Moved = G;
      Move(Moved, Side == 0 ? -Step : Step);
      Sides[Side] = loss(depths(Moved, C, O), Known);
    }
    return Weight * (Sides[1] - Sides[0]) / (2 * Step);
  };
  double Off = 0, Whole = 0;
  const auto Compare = [&](float Has, double Want) {
    Off += (Has - Want) * (Has - Want);
    Whole += Want * Want;
  };
  const auto Close = [&](const char *What) {
    EXPECT_GT(Whole, 0) << What;
    EXPECT_LE(std::sqrt(Off / Whole), 1e-5) << What;
    Off = Whole = 0;
  };
  using Changed = reference::Gaussians<double> &;
  for (std::size_t I = 0; I < S.size(); ++I)
    for (int K = 0; K < 3; ++K)
      Compare(Got.Means[3 * I + static_cast<std::size_t>(K)],
              Slope([&](Changed M, double By) { M.Means[I][K] += By; }));
  Close("means");
  for (std::size_t I = 0; I < S.size(); ++I)
    for (int K = 0; K < 3; ++K)
      Compare(
          Got.LogScales[3 * I + static_cast<std::size_t>(K)],
          Slope([&](Changed M, double By) { M.Scales[I][K] *= std::exp(By); }));
  Close("scales");
  for (std::size_t I = 0; I < S.size(); ++I)
    for (int K = 0; K < 4; ++K)
      Compare(Got.Quats[4 * I + static_cast<std::size_t>(K)],
              Slope([&](Changed M, double By) {
                glm::dvec4 Q(S.Quats[4 * I], S.Quats[4 * I + 1],
                             S.Quats[4 * I + 2], S.Quats[4 * I + 3]);
                Q[K] += By;
                M.Quats[I] = Q / std::sqrt(Q.x * Q.x + Q.y * Q.y + Q.z * Q.z +
                                           Q.w * Q.w);
              }));
  Close("rotations");
  for (std::size_t I = 0; I < S.size(); ++I)
    Compare(Got.OpacityLogits[I], Slope([&](Changed M, double By) {
              M.Opacities[I] =
                  1 / (1 + std::exp(-double{S.OpacityLogits[I]} - By));
            }));
  Close("opacities");
}

/// What is known of depths adds to what the picture says, to the bit nothing
/// where nothing is known.
TEST_P(DepthLossOnDevice, AddsToThePicture) {
  const auto [Convention, Blending] = GetParam();
  const Scene S = randomScene(Random, 24, 1);
  const Camera C = camera();
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  BackwardOptions Options;
  Options.Depths = true;
  std::normal_distribution<float> Normal;
  std::vector<float> ByRender(std::size_t{3} * 40 * 26);
  std::ranges::generate(ByRender, [&] { return Normal(Random); });
  const std::vector<float> None(ByRender.size(), 0);
  const std::vector<DepthPoint> Known{{500, 0.1F}, {510, 0.9F}}, Empty;
  const auto Means = [&](const BackwardOptions &B,
                         const std::vector<float> &Upstream,
                         const DepthTargets &Targets) {
    DeviceRenderer R(L, Convention, Blending, B, {});
    DeviceScene D = DeviceScene::upload(L, S);
    R.forward(D, C, 1);
    D.Parameters =
        R.backward(upload(L, Upstream), upload(L, None), Targets).Gradients;
    return D.download(L).Means;
  };
  const auto Plain = Means({}, ByRender, {});
  EXPECT_EQ(Means(Options, ByRender, {&Empty, 1}), Plain);
  const auto Deep = Means(Options, None, {&Known, 1});
  const auto Both = Means(Options, ByRender, {&Known, 1});
  ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
  EXPECT_GT(std::abs(*std::ranges::max_element(Deep)), 1e-3);
  for (std::size_t I = 0; I < Both.size(); ++I)
    EXPECT_NEAR(Both[I], Plain[I] + Deep[I],
                1e-4 * (1 + std::abs(Plain[I]) + std::abs(Deep[I])));
}

class KnownDepthsOnDevice : public DepthLossOnDevice {};

/// One photograph cannot tell a scene from one that is farther and larger.
/// Known depths can.
TEST_P(KnownDepthsOnDevice, PullTheSceneToItsPlace) {
  const Scene Truth = randomScene(Random, 24, 1);
  const Camera C = camera();
  const auto Shown = depths(toReference<double>(Truth), C, {});
  TrainView V{C, photographed(Truth, C), {}, {}};
  for (uint32_t P = 0; P < Shown.Render.size(); P += 3)
    if (const glm::dvec3 &D = Shown.Render[P]; D.y > 0.3)
      V.Depths.push_back({P, static_cast<float>(D.y / D.x)});
  Scene Far = Truth;
  for (std::size_t I = 0; I < Far.Means.size(); ++I)
    Far.Means[I] +=
        static_cast<float>(0.3 * (Far.Means[I] - C.Position[I % 3]));
  for (float &L : Far.LogScales)
    L += std::log(1.3F);
  const auto Wrong = [&](const Scene &S) {
    return loss(depths(toReference<double>(S), C, {}), V.Depths);
  };
  const auto After = [&](double Weight) {
    TrainRun Run;
    Run.Settings.PositionRate = Run.Settings.LastPositionRate = 0.02;
    Run.Settings.DepthWeight = Weight;
    TrainingSet Set{{V}, {}};
    if (Weight == 0)
      Set.Training[0].Depths.clear();
    Launcher L(*Dev, "", {});
    L.beginStage(Stage::Build);
    for (const ProgramSpec &P : Trainer::programs(Run.Settings, Set))
      L.build(P);
    BackwardOptions Options;
    Options.Depths = Weight > 0;
    DeviceRenderer R(L, Rules::Inria, std::get<1>(GetParam()), Options, {});
    OneRank Alone;
    Trainer T(L, R, Set, Run, Alone);
    T.start(Far);
    for (int I = 0; I < 60; ++I)
      T.step();
    EXPECT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
    return Wrong(T.scene());
  };
  const double Before = Wrong(Far);
  EXPECT_GT(After(0), 0.7 * Before);
  EXPECT_LT(After(1), 0.3 * Before);
}

INSTANTIATE_TEST_SUITE_P(Raster, KnownDepthsOnDevice,
                         testing::Values(std::tuple(Rules::Inria,
                                                    Path::Raster)));

INSTANTIATE_TEST_SUITE_P(
    Paths, DepthLossOnDevice,
    testing::Combine(testing::Values(Rules::Inria, Rules::Gsplat),
                     testing::Values(Path::Raster, Path::Simt)),
    [](const auto &Info) {
      return std::string(name(std::get<0>(Info.param))) + "_" +
             std::string(name(std::get<1>(Info.param)));
    });

} // namespace
} // namespace vorion::splat
