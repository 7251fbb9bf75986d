#include "Metrics.h"

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

TEST(Metrics, ANanOnOneSideIsTheWorstDifference) {
  const double Nan = std::nan("");
  const auto D = compare(std::vector<double>{Nan, 1}, {0, 1}, 1);
  EXPECT_EQ(D.PsnrDb, -Infinity);
  EXPECT_EQ(D.MaxAbs, Infinity);
  EXPECT_EQ(compare(std::vector<double>{Nan}, {Nan}, 1).PsnrDb, Infinity);
}

TEST(Metrics, EightBitValuesAreClampedAndRounded) {
  EXPECT_EQ(psnr8Bit({-3, 2, 0.5F}, {0, 1, 0.501F}), Infinity);
  EXPECT_NEAR(psnr8Bit({0}, {1}), 0, 1e-12);
}

} // namespace
