// Gradients of both paths against the reference's in fp64.
#include "train/optimize/DeviceRenderer.h"

#include "analyze/ToReference.h"
#include "device/OnDevice.h"
#include "reference/Backward.h"
#include "reference/Render.h"
#include "render/Planes.h"
#include "train/testing/SmallScenes.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {
namespace {

class GradientsOnDevice
    : public OnDevice,
      public testing::WithParamInterface<std::tuple<Rules, Path>> {
protected:
  struct Case {
    uint32_t Count;
    int ShDegree;
    double Spread; ///< of the means, world units
    double Wide;   ///< largest log scale
    bool Background;
    bool Antialiased = false;
  };

  Scene sceneOf(const Case &K) {
    return randomScene(
        Random, K.Count, K.ShDegree,
        {static_cast<float>(K.Spread), static_cast<float>(K.Wide) - 1, 1, 3});
  }

  static Camera camera() {
    Camera C;
    C.Width = 70; // partial tiles
    C.Height = 45;
    C.Fx = 60;
    C.Fy = 63;
    C.Cx = 36;
    C.Cy = 22;
    return aroundOrigin(C, 0.3, 0.1);
  }

  static double relativeError(const std::vector<double> &Got,
                              const std::vector<double> &Want) {
    double Squares = 0, Whole = 0;
    for (std::size_t I = 0; I < Got.size(); ++I) {
      Squares += (Got[I] - Want[I]) * (Got[I] - Want[I]);
      Whole += Want[I] * Want[I];
    }
    return std::sqrt(Squares / Whole);
  }
};

TEST_P(GradientsOnDevice, AreTheReferences) {
  const Case Cases[] = {{1, 0, 0.2, -1, false},
                        {60, 3, 1.5, -0.5, true},
                        {400, 2, 2, -2, true},
                        {300, 1, 6, -1, false}, // many outside, some culled
                        {60, 1, 1.5, -3, true, true}};
  for (const Case &K : Cases) {
    Launcher L(*Dev, "", {});
    const Scene S = sceneOf(K);
    const Camera C = camera();
    const auto [Convention, Blending] = GetParam();
    reference::Options O;
    O.Rule = toReference(Convention);
    O.Antialiased = K.Antialiased;
    std::array<float, 3> Background{};
    if (K.Background) {
      Background = {0.75F, 0.5F, 0.25F};
      O.Background = {0.75, 0.5, 0.25};
    }
    const auto G = toReference<double>(S);
    const auto Pose = toReference<double>(C);
    const auto Splats = reference::project(G, Pose, O);
    const auto Want = reference::blend(Splats, C.Width, C.Height, O);

    // Nothing comes back from pixels where fp32 may decide differently.
    std::vector<float> ByRender, ByAlpha;
    reference::Upstream U;
    std::normal_distribution<float> Normal;
    for (const uint8_t Doubt : Want.Doubts) {
      const float On = Doubt == 0 ? 1 : 0;
      for (int I = 0; I < 3; ++I)
        ByRender.push_back(On * Normal(Random));
      ByAlpha.push_back(On * Normal(Random));
      const float *Last = &ByRender[ByRender.size() - 3];
      U.Render.emplace_back(Last[0], Last[1], Last[2]);
      U.Alpha.push_back(ByAlpha.back());
    }
    const auto B = reference::renderBackward(G, Pose, U, O);

    L.beginStage(Stage::Blend);
    DeviceRenderer R(L, Convention, Blending, {},
                     {.Background = Background, .Antialiased = K.Antialiased});
    DeviceScene D = DeviceScene::upload(L, S);
    const cl::Buffer Picture = R.forward(D, C, K.ShDegree);
    const auto [Gradients, Seen] =
        R.backward(upload(L, ByRender), upload(L, ByAlpha), {});
    const auto Pixels = download<float>(L, Picture, 4 * ByAlpha.size());
    const auto Planes =
        download<float>(L, Seen.Gradients, (Seen.MeanPlane + 2) * S.size());
    D.Parameters = Gradients;
    const Scene Got = D.download(L);
    ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();

    for (std::size_t I = 0; I < Want.Render.size(); ++I)
      if (Want.Doubts[I] == 0)
        for (int Channel = 0; Channel < 3; ++Channel)
          EXPECT_NEAR(Pixels[4 * I + static_cast<std::size_t>(Channel)],
                      Want.Render[I][Channel], 2e-5);

    std::vector<double> Mean, Mean2d, LogScale, Quat, Logit, Sh;
    for (std::size_t I = 0; I < S.size(); ++I) {
      double Norm = 0;
      for (std::size_t Q = 0; Q < 4; ++Q)
        Norm += double(S.Quats[4 * I + Q]) * S.Quats[4 * I + Q];
      for (int A = 0; A < 3; ++A) {
        Mean.push_back(B.Means[I][A]);
        LogScale.push_back(B.Scales[I][A] * G.Scales[I][A]);
      }
      for (int A = 0; A < 4; ++A)
        Quat.push_back(B.Quats[I][A] / std::sqrt(Norm));
      Logit.push_back(B.Opacities[I] * G.Opacities[I] * (1 - G.Opacities[I]));
    }
    for (const glm::dvec3 &V : B.Sh)
      for (int A = 0; A < 3; ++A)
        Sh.push_back(V[A]);
    for (int A = 0; A < 2; ++A)
      for (const glm::dvec2 &V : B.Means2d)
        Mean2d.push_back(V[A]);
    const std::vector<float> Means2d(
        Planes.end() - static_cast<std::ptrdiff_t>(2 * S.size()), Planes.end());
    const auto Doubles = [](const std::vector<float> &V) {
      return std::vector<double>(V.begin(), V.end());
    };
    constexpr double Allowed = 1e-5;
    EXPECT_LE(relativeError(Doubles(Means2d), Mean2d), Allowed) << K.Count;
    EXPECT_LE(relativeError(Doubles(Got.Means), Mean), Allowed) << K.Count;
    EXPECT_LE(relativeError(Doubles(Got.LogScales), LogScale), Allowed)
        << K.Count;
    EXPECT_LE(relativeError(Doubles(Got.Quats), Quat), Allowed) << K.Count;
    EXPECT_LE(relativeError(Doubles(Got.OpacityLogits), Logit), Allowed)
        << K.Count;
    EXPECT_LE(relativeError(Doubles(Got.Sh), Sh), Allowed) << K.Count;
  }
}

class AbsoluteSumsOnDevice : public GradientsOnDevice {};

/// Sums over the pixels of what each of them alone gives: the way back is
/// linear in the pixels' gradients. The reference knows no absolute values.
TEST_P(AbsoluteSumsOnDevice, AreThoseOfThePixels) {
  const auto [Convention, Blending] = GetParam();
  reference::Options O;
  O.Rule = toReference(Convention);
  const Scene S = sceneOf({6, 0, 0.6, -1.5, false});
  Camera C = camera();
  C.Width = 20;
  C.Height = 9;
  C.Cx = 10;
  C.Cy = 4;
  const auto G = toReference<double>(S);
  const auto Pose = toReference<double>(C);
  const auto Pixels = static_cast<std::size_t>(C.Width * C.Height);
  std::normal_distribution<float> Normal;
  std::vector<float> ByRender(3 * Pixels);
  std::ranges::generate(ByRender, [&] { return Normal(Random); });
  const auto Doubts =
      reference::blend(reference::project(G, Pose, O), C.Width, C.Height, O)
          .Doubts;
  std::vector<double> Want(2 * S.size(), 0);
  double Cancelled = 0, Whole = 0;
  for (std::size_t P = 0; P < Pixels; ++P) {
    reference::Upstream U;
    U.Render.assign(Pixels, glm::dvec3(0));
    U.Alpha.assign(Pixels, 0);
    for (std::size_t K = 0; K < 3; ++K) {
      ByRender[3 * P + K] *= Doubts[P] == 0 ? 1.0F : 0.0F;
      U.Render[P][static_cast<int>(K)] = ByRender[3 * P + K];
    }
    const auto B = reference::renderBackward(G, Pose, U, O);
    for (std::size_t I = 0; I < S.size(); ++I) {
      Want[I] += std::abs(B.Means2d[I].x);
      Want[S.size() + I] += std::abs(B.Means2d[I].y);
      Cancelled += B.Means2d[I].x;
      Whole += std::abs(B.Means2d[I].x);
    }
  }
  EXPECT_LT(std::abs(Cancelled), 0.5 * Whole);
  BackwardOptions Options;
  Options.AbsoluteSums = true;
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  DeviceRenderer R(L, Convention, Blending, Options, {});
  const DeviceScene D = DeviceScene::upload(L, S);
  R.forward(D, C, 0);
  const auto [Gradients, Seen] = R.backward(
      upload(L, ByRender), upload(L, std::vector<float>(Pixels, 0)), {});
  EXPECT_EQ(Seen.MeanPlane, uint32_t{SUM_WORDS});
  const auto Planes =
      download<float>(L, Seen.Gradients, (Seen.MeanPlane + 2) * S.size());
  ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
  EXPECT_LE(
      relativeError({Planes.end() - static_cast<std::ptrdiff_t>(2 * S.size()),
                     Planes.end()},
                    Want),
      1e-5);
}

INSTANTIATE_TEST_SUITE_P(
    Paths, GradientsOnDevice,
    testing::Combine(testing::Values(Rules::Inria, Rules::Gsplat),
                     testing::Values(Path::Raster, Path::Simt)),
    [](const auto &Info) {
      return std::string(name(std::get<0>(Info.param))) + "_" +
             std::string(name(std::get<1>(Info.param)));
    });

INSTANTIATE_TEST_SUITE_P(Rules, AbsoluteSumsOnDevice,
                         testing::Combine(testing::Values(Rules::Inria,
                                                          Rules::Gsplat),
                                          testing::Values(Path::Simt)),
                         [](const auto &Info) {
                           return std::string(name(std::get<0>(Info.param)));
                         });

} // namespace
} // namespace vorion::splat
