#include "io/Metrics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace vorion::splat;

namespace {

const double Infinity = std::numeric_limits<double>::infinity();

TEST(Metrics, PsnrHasPeakOneOverAllChannels) {
  // One of six values differs by 0.1: mean square 0.01 / 6.
  const std::vector<double> A{0, 0, 0, 0, 0, 0}, B{0, 0.1, 0, 0, 0, 0};
  const auto D = compare(A, B, 3);
  EXPECT_EQ(D.Pixels, 2U);
  EXPECT_NEAR(D.PsnrDb, 10 * std::log10(6 / 0.01), 1e-12);
  EXPECT_EQ(D.MaxAbs, 0.1);
}

TEST(Metrics, IsUnclamped) {
  EXPECT_NEAR(compare(std::vector<double>{11}, {1}, 1).PsnrDb, -20, 1e-12);
}

TEST(Metrics, SkippedPixelsDoNotCount) {
  const std::vector<double> A{1, 2, 3, 4}, B{1, 2, 9, 9};
  const auto D = compare(A, B, 2, {0, 1});
  EXPECT_EQ(D.Pixels, 1U);
  EXPECT_EQ(D.PsnrDb, Infinity);
  EXPECT_EQ(compare(A, B, 2, {1, 0}).MaxAbs, 6);
}

/// A picture of NaNs must never pass for one that is right, however many other
/// pictures have them at the same places.
TEST(Metrics, WhatIsNoNumberEqualsNothing) {
  const double Nan = std::nan("");
  for (const double Bad : {Nan, Infinity, -Infinity})
    for (const double Other : {0.0, Bad}) {
      const auto D = compare(std::vector<double>{Bad, 1}, {Other, 1}, 1);
      EXPECT_EQ(D.PsnrDb, -Infinity) << Bad << " and " << Other;
      EXPECT_EQ(D.MaxAbs, Infinity);
      EXPECT_EQ(D.OffShare, 0.5);
      EXPECT_EQ(D.NotFinite, 1U);
      EXPECT_EQ(
          compare(std::vector<double>{Bad, 1}, {Other, 1}, 1, {1, 0}).PsnrDb,
          Infinity);
    }
}

TEST(Metrics, EightBitValuesAreClampedAndRounded) {
  EXPECT_EQ(psnr8Bit({-3, 2, 0.5F}, {0, 1, 0.501F}), Infinity);
  EXPECT_NEAR(psnr8Bit({0}, {1}), 0, 1e-12);
}

TEST(Metrics, OffPixelsHaveAChannelBeyondOneOf255) {
  const std::vector<double> A{0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(compare(A, {0, 1.0 / 255, 0, 0.004, 0.9, 0.9, 0, 0}, 2).OffShare,
            0.5);
}

TEST(Metrics, GradientsAreOffRelativeToThoseThatAreRight) {
  using Values = std::vector<double>;
  const double Nan = std::nan("");
  EXPECT_NEAR(relativeL2(Values{3, 4, 1}, Values{3, 4, 0}), 0.2, 1e-15);
  EXPECT_NEAR(relativeL2(Values{3, 4, 1}, Values{3, 4, 0}, 10), 0.1, 1e-15);
  EXPECT_EQ(relativeL2(Values{0, 0}, Values{0, 0}), 0);
  EXPECT_GT(relativeL2(Values{1e-9, 0}, Values{0, 0}), 1e200);
  EXPECT_EQ(relativeL2(Values{7, 1}, Values{Nan, 1}), 0);
  EXPECT_TRUE(std::isnan(relativeL2(Values{Nan, 1}, Values{0, 1})));
}

TEST(Metrics, SsimIsOneForEqualPicturesOnly) {
  std::vector<double> A;
  for (int I = 0; I < 40 * 30 * 3; ++I)
    A.push_back(I * 37 % 101 / 100.0);
  EXPECT_NEAR(ssim(A, A, 40, 3), 1, 1e-12);
  std::vector<double> B = A;
  for (double &V : B)
    V = 1 - V;
  EXPECT_LT(ssim(A, B, 40, 3), 0);
}

TEST(Metrics, MsSsimNeedsAWindowAtItsCoarsestScale) {
  std::vector<double> A;
  for (int I = 0; I < 180 * 176; ++I)
    A.push_back(I * 37 % 101 / 100.0);
  EXPECT_NEAR(*msSsim(A, A, 180, 1), 1, 1e-12);
  A.resize(std::size_t{180} * 175);
  EXPECT_FALSE(msSsim(A, A, 180, 1));
}

// Flat pictures have no variance inside: what is left is the means' term.
TEST(Metrics, SsimOfFlatPicturesIsTheMeansTerm) {
  const std::size_t Side = 64;
  const std::vector<double> A(Side * Side, 0.5), B(Side * Side, 0.25);
  const double Flat =
      (2 * 0.5 * 0.25 + 1e-4) / (0.5 * 0.5 + 0.25 * 0.25 + 1e-4);
  // The border's zeros count in its pixels only.
  EXPECT_NEAR(ssim(A, B, Side, 1), Flat, 0.15);
  EXPECT_LT(ssim(A, B, Side, 1), 0.9);
}

} // namespace
