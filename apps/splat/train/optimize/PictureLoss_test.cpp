// The device's loss against the reference's.
#include "train/optimize/PictureLoss.h"

#include "device/OnDevice.h"
#include "reference/Loss.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace vorion::splat {
namespace {

class LossOnDevice : public OnDevice {
protected:
  struct Result {
    LossValues Values;
    std::vector<float> Gradient; ///< 3 a pixel
    reference::Loss Want;
  };

  /// Four floats a pixel; the fourth must not matter.
  Result run(const std::vector<float> &Picture, const Photo &Target) {
    Launcher L(*Dev, "", {});
    L.beginStage(Stage::Blend);
    L.build(lossProgram());
    PictureLoss Loss(L, 0.2);
    Result R;
    R.Values = Loss.evaluate(upload(L, Picture), Target);
    R.Gradient = download<float>(L, Loss.gradient(), 3 * Target.pixels());
    std::vector<glm::dvec3> X, Y;
    for (std::size_t I = 0; I < Target.pixels(); ++I) {
      X.emplace_back(Picture[4 * I], Picture[4 * I + 1], Picture[4 * I + 2]);
      // As fp32 has it, so that equal is equal.
      const auto Level = [&](std::size_t K) {
        return static_cast<double>(Target.Rgb[3 * I + K] / 255.0F);
      };
      Y.emplace_back(Level(0), Level(1), Level(2));
    }
    R.Want = reference::lossOf(X, Y, Target.Width, Target.Height);
    return R;
  }

  /// Largest difference of a gradient from the reference's, in units of one
  /// pixel's share of the loss.
  static double gradientError(const Result &R) {
    double Worst = 0;
    const double Share = 3.0 * static_cast<double>(R.Want.Gradient.size());
    for (std::size_t I = 0; I < R.Want.Gradient.size(); ++I)
      for (int C = 0; C < 3; ++C)
        Worst = std::max(Worst,
                         std::abs(R.Gradient[3 * I + static_cast<unsigned>(C)] -
                                  R.Want.Gradient[I][C]) *
                             Share);
    return Worst;
  }

  static Photo noisyPhoto(int Width, int Height) {
    std::mt19937 Random(11);
    Photo P{Width, Height, {}};
    P.Rgb.resize(std::size_t{3} * static_cast<unsigned>(Width * Height));
    std::ranges::generate(P.Rgb, [&] { return Random() % 256; });
    return P;
  }
};

TEST_F(LossOnDevice, IsTheReferencesOnPicturesOfAnySize) {
  std::mt19937 Random(12);
  std::uniform_real_distribution<float> Value(-0.1F, 1.2F);
  // Smaller than the window, one row, one pixel, several tiles each way.
  const std::pair<int, int> Sizes[] = {{37, 23}, {8, 6},  {30, 1}, {1, 12},
                                       {1, 1},   {64, 5}, {19, 66}};
  for (const auto &[Width, Height] : Sizes) {
    std::vector<float> Picture(std::size_t{4} *
                               static_cast<unsigned>(Width * Height));
    std::ranges::generate(Picture, [&] { return Value(Random); });
    const Result R = run(Picture, noisyPhoto(Width, Height));
    EXPECT_NEAR(R.Values.Absolute, R.Want.Absolute, 2e-7);
    EXPECT_NEAR(R.Values.Ssim, R.Want.Ssim, 2e-6);
    EXPECT_NEAR(R.Values.Value, R.Want.Value, 1e-6);
    EXPECT_LE(gradientError(R), 1e-4) << Width << "x" << Height;
  }
}

/// Where variances cancel: SSIM's slopes are large there, and fp32 must not
/// make a gradient out of rounding that would move a perfect picture.
TEST_F(LossOnDevice, ConstantPicturesHaveTheReferencesGradient) {
  for (const int Level : {0, 1, 128, 255}) {
    Photo Target{24, 20,
                 std::vector<uint8_t>(std::size_t{3} * 24 * 20,
                                      static_cast<uint8_t>(Level))};
    for (const float Offset : {0.0F, 1.0F / 255, -0.5F}) {
      const std::vector<float> Picture(std::size_t{4} * 24 * 20,
                                       static_cast<float>(Level) / 255.0F +
                                           Offset);
      const Result R = run(Picture, Target);
      EXPECT_NEAR(R.Values.Value, R.Want.Value, 2e-5);
      EXPECT_LE(gradientError(R), 2e-2) << Level << " " << Offset;
    }
  }
}

/// The reference has what does not count black on both sides; its means are
/// over all pixels.
TEST_F(LossOnDevice, PixelsThatDoNotCountAreInNoMean) {
  constexpr int Width = 40, Height = 30;
  std::mt19937 Random(14);
  std::uniform_real_distribution<float> Value(0, 1);
  std::vector<float> Picture(std::size_t{4} * Width * Height);
  std::ranges::generate(Picture, [&] { return Value(Random); });
  Photo Target = noisyPhoto(Width, Height);
  std::vector<uint8_t> Counts(Target.pixels());
  double Counted = 0;
  for (std::size_t I = 0; I < Counts.size(); ++I) {
    // A block, and single ones.
    Counts[I] = !(I % Width < 25 && I / Width > 10) && Random() % 8 != 0;
    Counted += Counts[I];
  }
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  L.build(lossProgram());
  L.build(maskProgram());
  PictureLoss Loss(L, 0.2);
  const LossValues Got = Loss.evaluate(upload(L, Picture), Target, Counts);
  const auto Gradient = download<float>(L, Loss.gradient(), 3 * Counts.size());
  std::vector<glm::dvec3> X(Counts.size()), Y(Counts.size());
  for (std::size_t I = 0; I < Counts.size(); ++I)
    for (int K = 0; K < 3 && Counts[I] != 0; ++K) {
      const auto Channel = static_cast<std::size_t>(K);
      X[I][K] = Picture[4 * I + Channel];
      Y[I][K] = static_cast<double>(Target.Rgb[3 * I + Channel] / 255.0F);
    }
  const auto Want = reference::lossOf(X, Y, Width, Height);
  const double Share = static_cast<double>(Counts.size()) / Counted;
  EXPECT_NEAR(Got.Value, Want.Value * Share, 1e-6);
  for (std::size_t I = 0; I < Counts.size(); ++I)
    for (int K = 0; K < 3; ++K) {
      const auto At = 3 * I + static_cast<std::size_t>(K);
      if (Counts[I] == 0)
        ASSERT_EQ(Gradient[At], 0);
      else
        ASSERT_NEAR(Gradient[At] * 3 * Counted,
                    Want.Gradient[I][K] * Share * 3 * Counted, 1e-4);
    }
  // What does not count is not even looked at, and all may count.
  for (std::size_t I = 0; I < Counts.size(); ++I)
    if (Counts[I] == 0)
      Target.Rgb[3 * I] ^= 0xff;
  EXPECT_EQ(Loss.evaluate(upload(L, Picture), Target, Counts).Value, Got.Value);
  const std::vector<uint8_t> All(Counts.size(), 1);
  EXPECT_NEAR(Loss.evaluate(upload(L, Picture), Target, All).Value,
              Loss.evaluate(upload(L, Picture), Target).Value, 1e-9);
}

TEST_F(LossOnDevice, LaterPicturesMayBeSmallerOrLarger) {
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  L.build(lossProgram());
  PictureLoss Loss(L, 0.2);
  std::vector<double> Values;
  for (const int Side : {9, 30, 9}) {
    const std::vector<float> Picture(
        std::size_t{4} * static_cast<unsigned>(Side * Side), 0.5F);
    Values.push_back(
        Loss.evaluate(upload(L, Picture), noisyPhoto(Side, Side)).Value);
  }
  EXPECT_EQ(Values[0], Values[2]);
  EXPECT_NE(Values[0], Values[1]);
}

} // namespace
} // namespace vorion::splat
