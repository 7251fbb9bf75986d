// Gradients of views that see some Gaussians, or none.
#include "render/Gradients.h"

#include "device/OnDevice.h"

#include <algorithm>
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

} // namespace
} // namespace vorion::splat
