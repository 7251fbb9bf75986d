// The enhanced unified camera model by its geometry: a ray meets the quadric
// beta (x^2 + y^2) + z^2 = 1, and what it meets is seen from a centre behind.

#include "reference/Lens.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion::reference;

namespace {

Lens lensOf(double Alpha, double Beta) {
  Lens L;
  L.Model = &lenses::Eucm;
  L.K = {Alpha, Beta};
  L.Limit = lenses::Eucm.Limit(L.K);
  return L;
}

TEST(Eucm, PlacesAreThoseOfTheQuadric) {
  for (const double Alpha : {0., 0.3, 0.5, 0.8, 1.})
    for (const double Beta : {0.4, 1., 2.5})
      for (const double Angle : {1e-6, 0.4, 1.1, 1.57}) {
        // Where the quadric is met, and a centre so far behind its own that
        // the focal length is 1 for what is close to the axis.
        const double Out = std::sin(Angle), Deep = std::cos(Angle);
        const double Met = 1 / std::sqrt(Beta * Out * Out + Deep * Deep);
        const double Want = Out * Met / (Alpha + (1 - Alpha) * Deep * Met);
        glm::dvec2 At;
        ASSERT_TRUE(placeThrough(
            lensOf(Alpha, Beta),
            glm::dvec3(0.6 * 3 * Out, -0.8 * 3 * Out, 3 * Deep), At));
        EXPECT_NEAR(At.x, 0.6 * Want, 1e-13 * (1 + Want)) << Alpha;
        EXPECT_NEAR(At.y, -0.8 * Want, 1e-13 * (1 + Want)) << Alpha;
        const auto Ray = lenses::Eucm.Ray({Alpha, Beta}, At);
        ASSERT_TRUE(Ray) << Alpha << " " << Beta << " " << Angle;
        EXPECT_NEAR(std::atan2(std::hypot(Ray->x, Ray->y), Ray->z), Angle,
                    1e-9);
      }
}

// alpha 0 is a pinhole; alpha 1/2 and beta 1 is the stereographic projection.
TEST(Eucm, HasKnownProjections) {
  glm::dvec2 At;
  for (const double Angle : {0.1, 0.8, 1.5}) {
    const glm::dvec3 P(std::sin(Angle), 0, std::cos(Angle));
    ASSERT_TRUE(placeThrough(lensOf(0, 3), P, At));
    EXPECT_NEAR(At.x, std::tan(Angle), 1e-12 * std::tan(Angle));
    ASSERT_TRUE(placeThrough(lensOf(0.5, 1), P, At));
    EXPECT_NEAR(At.x, 2 * std::tan(Angle / 2), 1e-13);
    ASSERT_TRUE(placeThrough(lensOf(1, 1), P, At));
    EXPECT_NEAR(At.x, std::sin(Angle), 1e-13);
  }
}

// As COLMAP has it, what is beside or behind the camera is not seen.
TEST(Eucm, ItEndsBesideTheCamera) {
  glm::dvec2 At;
  EXPECT_FALSE(placeThrough(lensOf(0.8, 1), glm::dvec3(1, 0, 0), At));
  EXPECT_FALSE(placeThrough(lensOf(0.8, 1), glm::dvec3(1, 0, -0.1), At));
  EXPECT_TRUE(placeThrough(lensOf(0.5, 4), glm::dvec3(1e9, 0, 1), At));
  EXPECT_NEAR(At.x, 1, 1e-8);
  for (const double Alpha : {0.2, 0.5, 1.}) {
    const double End = 1 / (Alpha * std::sqrt(4));
    EXPECT_TRUE(lenses::Eucm.Ray({Alpha, 4}, {0.999999 * End, 0})) << Alpha;
    EXPECT_FALSE(lenses::Eucm.Ray({Alpha, 4}, {1.000001 * End, 0})) << Alpha;
  }
  EXPECT_TRUE(lenses::Eucm.Ray({0, 4}, {1e3, 1e3}));
}

} // namespace
