#include "vorion/support/Polynomial.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion;

namespace {

TEST(Polynomial, IsEvaluatedFromTheHighestPower) {
  EXPECT_EQ(evaluate({}, 3), 0);
  EXPECT_EQ(evaluate(Polynomial{7}, 3), 7);
  EXPECT_EQ(evaluate(Polynomial{1, -2, 0, 4}, 3), 1 - 6 + 108);
}

TEST(Polynomial, DerivativeAndProductAreThoseOfTheCoefficients) {
  EXPECT_EQ(derivative(Polynomial{1, -2, 3, 4}), (Polynomial{-2, 6, 12}));
  EXPECT_TRUE(derivative(Polynomial{5}).empty());
  EXPECT_EQ(product(Polynomial{1, 2}, Polynomial{3, 0, -1}),
            (Polynomial{3, 6, -1, -2}));
}

// (x - 1) (x - 2) (x - 4), and (x - 1)^2, which touches 0 and keeps its sign.
TEST(Polynomial, SignChangesAreTheRootsOfOddOrderInOrder) {
  const Polynomial Cubic{-8, 14, -7, 1};
  const auto All = signChanges(Cubic, 10);
  ASSERT_EQ(All.size(), 3U);
  EXPECT_NEAR(All[0], 1, 1e-14);
  EXPECT_NEAR(All[1], 2, 1e-14);
  EXPECT_NEAR(All[2], 4, 1e-14);
  EXPECT_EQ(signChanges(Cubic, 3).size(), 2U);
  EXPECT_TRUE(signChanges({1, -2, 1}, 10).empty());
  EXPECT_TRUE(signChanges({1}, 10).empty());
}

TEST(Polynomial, BisectionEndsAtTheLastBit) {
  const double Root = bisect(0, 2, [](double X) { return X * X < 2; });
  EXPECT_GE(Root * Root, 2);
  const double Below = std::nextafter(Root, 0);
  EXPECT_LT(Below * Below, 2);
  EXPECT_EQ(bisect(0, 2, [](double) { return true; }), 2);
}

} // namespace
