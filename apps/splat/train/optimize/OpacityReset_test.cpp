// What a reset of opacities leaves of the gradients: an alpha below 1/255 is
// not blended and gives none.

#include "analyze/ToReference.h"
#include "device/OnDevice.h"
#include "picture/Layout.h"
#include "reference/Backward.h"
#include "reference/Render.h"
#include "render/Planes.h"
#include "scene/Activation.h"
#include "train/optimize/DeviceRenderer.h"
#include "train/run/Trainer.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {
namespace {

class ResetOnDevice : public OnDevice,
                      public testing::WithParamInterface<Path> {
protected:
  static constexpr double ResetOpacity = 0.01;
  static constexpr int Width = 64, Height = 48, Focal = 50;

  /// \p Count within the picture, 0.03 to 3 px wide, just reset.
  Scene resetScene(uint32_t Count) {
    std::uniform_real_distribution<double> Unit(0, 1);
    Scene S = Scene::sized(Count, 0);
    for (std::size_t I = 0; I < Count; ++I) {
      const double Z = 2 + 2 * Unit(Random);
      const double At[3] = {(Unit(Random) - 0.5) * Width * Z / Focal,
                            (Unit(Random) - 0.5) * Height * Z / Focal, Z};
      const double Scale = 0.03 * std::pow(100, Unit(Random)) * Z / Focal;
      for (std::size_t K = 0; K < 3; ++K) {
        S.Means[3 * I + K] = static_cast<float>(At[K]);
        S.LogScales[3 * I + K] = static_cast<float>(std::log(Scale));
        S.Sh[3 * I + K] = static_cast<float>(Unit(Random));
      }
      S.Quats[4 * I] = 1;
      S.OpacityLogits[I] = opacityLogit(ResetOpacity);
    }
    return S;
  }

  /// Of those whose opacity has a gradient of exactly 0 on the device, and in
  /// fp64.
  struct Silent {
    std::vector<bool> Device, Reference;
  };

  Silent silentOf(const Scene &S, bool Antialiased) {
    const Camera C = Camera::ahead(Width, Height, Focal);
    std::normal_distribution<float> Normal;
    std::vector<float> ByRender, ByAlpha;
    reference::Upstream U;
    for (int I = 0; I < Width * Height; ++I) {
      const float V[4] = {Normal(Random), Normal(Random), Normal(Random),
                          Normal(Random)};
      ByRender.insert(ByRender.end(), V, V + 3);
      ByAlpha.push_back(V[3]);
      U.Render.emplace_back(V[0], V[1], V[2]);
      U.Alpha.push_back(V[3]);
    }
    reference::Options O;
    O.Antialiased = Antialiased;
    const auto Want = reference::renderBackward(toReference<double>(S),
                                                toReference<double>(C), U, O);

    Launcher L(*Dev, "", {});
    L.beginStage(Stage::Blend);
    DeviceRenderer R(L, Rules::Inria, GetParam(), {},
                     {.Antialiased = Antialiased});
    DeviceScene D = DeviceScene::upload(L, S);
    R.forward(D, C, 0);
    D.Parameters =
        R.backward(upload(L, ByRender), upload(L, ByAlpha), {}).Gradients;
    const Scene Got = D.download(L);
    EXPECT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
    Silent Out;
    for (std::size_t I = 0; I < S.size(); ++I) {
      Out.Device.push_back(Got.OpacityLogits[I] == 0);
      Out.Reference.push_back(Want.Opacities[I] == 0);
    }
    return Out;
  }
};

// The dilation makes each at least 0.548 px wide, so that an opacity of 0.01
// reaches 0.749 px, and no place is further than 0.708 px from a pixel's
// centre.
TEST_P(ResetOnDevice, LeavesAGradientToWhatIsInThePicture) {
  const Silent Found = silentOf(resetScene(300), /*Antialiased=*/false);
  EXPECT_EQ(std::ranges::count(Found.Device, true), 0);
  EXPECT_EQ(Found.Device, Found.Reference);
}

// What is less than 0.43 px wide has less than 0.39 of its opacity.
TEST_P(ResetOnDevice, LeavesNoneToTheSmallWhereOpacitiesAreCompensated) {
  const Scene S = resetScene(300);
  const Silent Found = silentOf(S, /*Antialiased=*/true);
  EXPECT_EQ(Found.Device, Found.Reference);
  for (std::size_t I = 0; I < S.size(); ++I) {
    const double Pixels =
        std::exp(double(S.LogScales[3 * I])) * Focal / S.Means[3 * I + 2];
    if (Pixels < 0.42)
      EXPECT_TRUE(Found.Device[I]) << I;
    else if (Pixels > 1)
      EXPECT_FALSE(Found.Device[I]) << I;
  }
  const auto None = std::ranges::count(Found.Device, true);
  RecordProperty("without_gradient", static_cast<int>(None));
  EXPECT_GT(None, 100);
}

// They keep their bits however long a run goes on, the others come back, and
// the change of density counts them.
TEST_P(ResetOnDevice, TheSmallNeverComeBack) {
  const Scene S = resetScene(60);
  std::size_t Small = 0;
  for (std::size_t I = 0; I < S.size(); ++I)
    Small += std::exp(double(S.LogScales[3 * I])) * Focal / S.Means[3 * I + 2] <
             0.42;
  ASSERT_GT(Small, 10U);
  // A white picture: all want to be seen.
  TrainingSet Set;
  const Camera C = Camera::ahead(Width, Height, Focal);
  Set.Training.push_back(
      {C,
       {Width, Height, std::vector<uint8_t>(3 * Width * Height, 255)},
       {},
       {}});
  TrainRun Run;
  Run.Antialiased = true;
  Run.Settings.DensifyAfter = 1;
  Run.Settings.DensifyInterval = 30;
  Run.Settings.DensifyGradient = 1e9; // nothing grows
  Run.Settings.ScaleRate = Run.Settings.PositionRate = 0;
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  for (const ProgramSpec &P : Trainer::programs(Run.Settings, Set))
    L.build(P);
  DeviceRenderer R(L, Rules::Inria, GetParam(), {}, {.Antialiased = true});
  OneRank Alone;
  Trainer T(L, R, Set, Run, Alone);
  T.start(S);
  std::optional<DensityChange> Change;
  for (int I = 0; I < 31; ++I)
    if (const auto Step = T.step(); Step.Density)
      Change = Step.Density;
  ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
  ASSERT_TRUE(Change);
  EXPECT_GE(Change->WithoutGradient, Small);
  EXPECT_LT(Change->WithoutGradient, S.size());
  ASSERT_EQ(Change->After, S.size());
  const Scene After = T.scene();
  std::size_t Kept = 0;
  for (std::size_t I = 0; I < S.size(); ++I)
    Kept += After.OpacityLogits[I] == S.OpacityLogits[I];
  EXPECT_EQ(Kept, Change->WithoutGradient);
}

INSTANTIATE_TEST_SUITE_P(Paths, ResetOnDevice,
                         testing::Values(Path::Raster, Path::Simt),
                         [](const auto &P) {
                           return std::string(name(P.param));
                         });

} // namespace
} // namespace vorion::splat
