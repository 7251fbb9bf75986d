// The division model by Fitzgibbon's definition, which is its way back.

#include "reference/Lens.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion::reference;

namespace {

Lens lensOf(double K) {
  Lens L;
  L.Model = &lenses::Division;
  L.K = {K};
  L.Limit = lenses::Division.Limit(L.K);
  return L;
}

// What is shown at d, a pinhole shows at d / (1 + k d^2).
TEST(Division, WhatIsShownAtDAPinholeShowsAtTheQuotient) {
  for (const double K : {-0.7, -0.1, 0., 0.05, 0.3})
    for (const double D : {1e-6, 0.2, 0.6, 1.1}) {
      const double Pinhole = D / (1 + K * D * D);
      glm::dvec2 At;
      ASSERT_TRUE(placeThrough(
          lensOf(K), glm::dvec3(0.6 * Pinhole * 3, 0.8 * Pinhole * 3, 3), At));
      EXPECT_NEAR(At.x, 0.6 * D, 1e-13 * (1 + D)) << K;
      EXPECT_NEAR(At.y, 0.8 * D, 1e-13 * (1 + D)) << K;
    }
}

// The quotient's largest value, at d = 1 / sqrt(k); of a negative k the picture
// ends at its pole, which a pinhole shows nowhere.
TEST(Division, ItEndsWhereTheQuotientTurnsBack) {
  glm::dvec2 At;
  EXPECT_TRUE(placeThrough(lensOf(0.25), glm::dvec3(0.9999, 0, 1), At));
  EXPECT_NEAR(At.x, 2, 0.03);
  EXPECT_FALSE(placeThrough(lensOf(0.25), glm::dvec3(1.0001, 0, 1), At));
  EXPECT_FALSE(placeThrough(lensOf(0.25), glm::dvec3(0.1, 0, -1), At));
  EXPECT_TRUE(placeThrough(lensOf(-0.25), glm::dvec3(1e9, 0, 1), At));
  EXPECT_NEAR(At.x, 2, 1e-8);
  EXPECT_FALSE(lenses::Division.Ray({-0.25}, {2.01, 0}).has_value());
  EXPECT_FALSE(lenses::Division.Ray({0.25}, {2.01, 0}).has_value());
}

} // namespace
