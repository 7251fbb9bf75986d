// Gradients of views that see some Gaussians, or none, and in front of a mesh.
#include "render/Gradients.h"

#include "analyze/ToReference.h"
#include "device/OnDevice.h"
#include "mesh/Mesh.h"
#include "reference/Backward.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorion::splat {
namespace {

class GradientsOnDevice : public OnDevice {
protected:
  GradientsOnDevice() {
    O.Blending = Path::Simt;
    O.Training = true;
    const std::size_t Pixels = std::size_t{16} * 16;
    U.Render.assign(3 * Pixels, 1);
    U.Alpha.assign(Pixels, 0);
  }

  /// Of a scene with Gaussians at depths \p Z, on a device whose memory has
  /// been used before.
  GradientResult gradients(const std::vector<float> &Z) {
    Scene S = Scene::sized(Z.size(), 0);
    for (std::size_t I = 0; I < Z.size(); ++I) {
      S.Means[3 * I + 2] = Z[I];
      S.Quats[4 * I] = 1;
    }
    Launcher L(*Dev, "", {});
    L.beginStage(Stage::Blend);
    upload(L, std::vector<float>(1 << 20,
                                 std::numeric_limits<float>::quiet_NaN()));
    const auto R = takeGradients(L, S, Camera::ahead(16, 16, 16), O, {}, U);
    EXPECT_TRUE(R) << R.error().What << L.buildLog();
    return R ? *R : GradientResult();
  }

  RenderOptions O;
  PixelGradients U;
};

TEST_F(GradientsOnDevice, WhatIsNotSeenHasSumsOf0) {
  const GradientResult R = gradients({-2, 2, -3});
  EXPECT_EQ(R.Visible, 1U);
  ASSERT_EQ(R.Gradients.Sums.size(), std::size_t{3} * SUM_WORDS);
  for (std::size_t K = 0; K < SUM_WORDS; ++K)
    for (const std::size_t Unseen : {0U, 2U})
      EXPECT_EQ(R.Gradients.Sums[3 * K + Unseen], 0) << K;
  EXPECT_NE(R.Gradients.Sums[3 * SUM_COLOR + 1], 0);
}

TEST_F(GradientsOnDevice, AViewOfNothingHasGradientsOf0) {
  const GradientResult R = gradients({-2, -3});
  EXPECT_EQ(R.Visible, 0U);
  const auto AreZero = [](const std::vector<float> &Values) {
    return !Values.empty() &&
           std::ranges::all_of(Values, [](float V) { return V == 0; });
  };
  EXPECT_TRUE(AreZero(R.Gradients.Means));
  EXPECT_TRUE(AreZero(R.Gradients.Sh));
  EXPECT_TRUE(AreZero(R.Gradients.Sums));
}

// A wall through the Gaussians hides some, and is what others are blended over.
TEST_F(GradientsOnDevice, InFrontOfAMeshTheyAreTheReferences) {
  constexpr int Width = 70, Height = 45;
  const Camera C = Camera::ahead(Width, Height, 40);
  Scene S = Scene::sized(150, 1);
  std::uniform_real_distribution<float> One(-1, 1);
  for (std::size_t I = 0; I < S.size(); ++I) {
    S.Means[3 * I] = 1.5F * One(Random);
    S.Means[3 * I + 1] = One(Random);
    S.Means[3 * I + 2] = 2.5F + One(Random);
    for (std::size_t A = 0; A < 3; ++A)
      S.LogScales[3 * I + A] = -2 + 0.5F * One(Random);
    for (std::size_t Q = 0; Q < 4; ++Q)
      S.Quats[4 * I + Q] = One(Random);
    S.OpacityLogits[I] = One(Random);
  }
  for (float &Coefficient : S.Sh)
    Coefficient = 0.5F * One(Random);
  Mesh M;
  M.Materials.emplace_back();
  std::vector<MeshCorner> Wall;
  for (const auto &[X, Y, Z] : {std::array{-1.0F, -2.0F, 1.8F},
                                {1.0F, -2.0F, 3.2F},
                                {1.0F, 2.0F, 3.2F},
                                {-1.0F, 2.0F, 1.8F}})
    Wall.push_back({M.addVertex({X, Y, Z}, {0.75F, 0.25F, 0.5F, 1}), {}, {}});
  M.addPolygon(Wall, 0);
  O.Background = {0.25F, 0.5F, 0.75F};
  O.Surface = std::make_shared<const Mesh>(M);
  O.KeepVisible = true;

  for (const Path By : {Path::Raster, Path::Simt}) {
    O.Blending = By;
    const auto Take = [&] {
      Launcher L(*Dev, "", {});
      const auto R = takeGradients(L, S, C, O, {}, U);
      EXPECT_TRUE(R) << R.error().What << L.buildLog();
      return R ? *R : GradientResult();
    };
    constexpr std::size_t Pixels = std::size_t{Width} * Height;
    U.Render.assign(3 * Pixels, 0);
    U.Alpha.assign(Pixels, 0);
    const GradientResult Shown = Take();
    ASSERT_TRUE(Shown.MeshShown);
    reference::Surface<double> Behind;
    Behind.Depths.assign(Shown.MeshShown->Depth.begin(),
                         Shown.MeshShown->Depth.end());
    Behind.Colors.assign(Pixels, {0.75, 0.25, 0.5});
    const auto G = toReference<double>(S);
    const auto Pose = toReference<double>(C);
    const reference::Options Rules = toReference(O);
    const auto Picture = reference::render(G, Pose, Rules, &Behind);
    reference::Upstream Loss;
    std::size_t Kept = 0;
    for (std::size_t P = 0; P < Pixels; ++P) {
      const bool IsSure = Picture.Doubts[P] == 0;
      Kept += IsSure;
      for (std::size_t A = 0; A < 3; ++A) {
        U.Render[3 * P + A] = IsSure ? One(Random) : 0;
        if (IsSure)
          EXPECT_NEAR(Shown.Picture.Render[3 * P + A],
                      Picture.Render[P][static_cast<int>(A)], 2e-5);
      }
      U.Alpha[P] = IsSure ? One(Random) : 0;
      Loss.Render.emplace_back(U.Render[3 * P], U.Render[3 * P + 1],
                               U.Render[3 * P + 2]);
      Loss.Alpha.push_back(U.Alpha[P]);
    }
    EXPECT_GT(Kept, Pixels * 9 / 10);
    const auto Want = reference::renderBackward(G, Pose, Loss, Rules, &Behind);
    const auto Open = reference::renderBackward(G, Pose, Loss, Rules);
    const SceneGradients Got = Take().Gradients;
    const auto ErrorOf = [](const auto &Is, const auto &Rows, auto PartOf) {
      double Squares = 0, All = 0;
      for (std::size_t I = 0; I < Is.size(); ++I) {
        const double Should = PartOf(Rows, I);
        Squares += (Is[I] - Should) * (Is[I] - Should);
        All += Should * Should;
      }
      return std::sqrt(Squares / All);
    };
    const auto OfVector = [](const auto &Rows, std::size_t I) {
      return Rows[I / 3][static_cast<int>(I % 3)];
    };
    const auto OfNumber = [](const auto &Rows, std::size_t I) {
      return Rows[I];
    };
    EXPECT_LE(ErrorOf(Got.Means, Want.Means, OfVector), 1e-5);
    EXPECT_LE(ErrorOf(Got.Scales, Want.Scales, OfVector), 1e-5);
    EXPECT_LE(ErrorOf(Got.Opacities, Want.Opacities, OfNumber), 1e-5);
    EXPECT_LE(ErrorOf(Got.Sh, Want.Sh, OfVector), 1e-5);
    // Without the mesh they are others.
    EXPECT_GE(ErrorOf(Got.Means, Open.Means, OfVector), 0.1);
  }
}

} // namespace
} // namespace vorion::splat
