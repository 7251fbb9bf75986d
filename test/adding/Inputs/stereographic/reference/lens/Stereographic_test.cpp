#include "reference/Lens.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion::reference;

namespace {

TEST(Stereographic, PlacesAreTwiceTheTangentOfHalfTheAngle) {
  Lens L;
  L.Model = &lenses::Stereographic;
  for (const double Angle : {0.01, 0.5, 1.5, 3.0}) {
    glm::dvec2 At;
    ASSERT_TRUE(placeThrough(
        L, glm::dvec3(0, 5 * std::sin(Angle), 5 * std::cos(Angle)), At));
    EXPECT_NEAR(At.y, 2 * std::tan(Angle / 2), 1e-12);
  }
}

} // namespace
