// Where camera models end.

#include "io/CameraModel.h"
#include "lens/Models.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace vorion::splat {
namespace {

constexpr double Infinity = std::numeric_limits<double>::infinity();

double openCvLimit(LensCoefficients K) {
  return CameraModel{&lenses::OpenCv, K}.limit();
}
double fisheyeLimit(LensCoefficients K) {
  return CameraModel{&lenses::Fisheye, K}.limit();
}

TEST(CameraModel, OpenCvsLimitIsWhereRadiiTurnBackOrHaveAPole) {
  EXPECT_EQ(openCvLimit({}), Infinity);
  EXPECT_EQ(openCvLimit({0.5}), Infinity);
  // 1 + 3 k1 q
  EXPECT_NEAR(openCvLimit({-0.3}), std::sqrt(1 / 0.9), 1e-14);
  EXPECT_NEAR(openCvLimit({-1e6}), std::sqrt(1 / 3e6), 1e-14);
  EXPECT_NEAR(openCvLimit({-1e-6}), std::sqrt(1 / 3e-6), 1e-9);
  // 1 + 3 k1 q + 5 k2 q^2: the smaller of two roots, or none.
  EXPECT_NEAR(openCvLimit({-1, 0.1}), std::sqrt((3 - std::sqrt(9 - 2.)) / 1),
              1e-12);
  EXPECT_EQ(openCvLimit({-1, 0.6}), Infinity);
  // 1 + 9 r8 q^4
  EXPECT_NEAR(openCvLimit({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -0.01}),
              std::pow(1 / 0.09, 1. / 8), 1e-13);
  // 1 + k4 q below: (1 - k4 q) / (1 + k4 q)^2.
  EXPECT_NEAR(openCvLimit({0, 0, 0, 0, 0, 4}), 0.5, 1e-14);
  EXPECT_NEAR(openCvLimit({0, 0, 0, 0, 0, -4}), 0.5, 1e-14);
  // What is not radial has no say.
  EXPECT_EQ(openCvLimit({0, 0, 5, 5, 0, 0, 0, 0, 5, 5, 5, 5}), Infinity);
}

TEST(CameraModel, AFisheyesLimitIsAnAngle) {
  EXPECT_EQ(fisheyeLimit({}), M_PI);
  EXPECT_EQ(fisheyeLimit({0.1}), M_PI);
  EXPECT_NEAR(fisheyeLimit({-0.1}), std::sqrt(1 / 0.3), 1e-14);
  EXPECT_EQ(fisheyeLimit({-0.03}), M_PI); // turns back at 3.33
  EXPECT_NEAR(fisheyeLimit({0, 0, 0, -0.01}), std::pow(1 / 0.09, 1. / 8),
              1e-14);
}

TEST(CameraModel, APinholeSeesAFisheyeUpToARightAngle) {
  EXPECT_EQ((CameraModel{&lenses::Fisheye, {}}).reach(), Infinity);
  EXPECT_NEAR((CameraModel{&lenses::Fisheye, {-0.3}}).reach(),
              std::tan(std::sqrt(1 / 0.9)), 1e-12);
  EXPECT_EQ((CameraModel{&lenses::Fisheye, {-0.1}}).reach(), Infinity);
}

// The places of reference/Lens_test.cpp, by OpenCV 4.6.
TEST(CameraModel, PlacesAreThoseOfOpenCv) {
  const CameraModel Barrel{&lenses::OpenCv,
                           {-0.28, 0.09, 0.002, -0.003, -0.012, 0.03, 0.02,
                            0.001, 0.004, -0.001, 0.002, 0.0005}};
  const CameraModel Fish{&lenses::Fisheye, {0.05, -0.01, 0.004, -0.0008}};
  const auto Expect = [](const CameraModel &M, double X, double Y, double AtX,
                         double AtY) {
    const auto [U, V] = M.distorted(X, Y);
    EXPECT_NEAR(40 * U + 30, AtX, 1e-9);
    EXPECT_NEAR(42 * V + 25, AtY, 1e-9);
  };
  Expect(Barrel, -0.4, 0.5, 15.770138415972, 43.761803179036);
  Expect(Barrel, 0.8 / 1.2, 0.1 / 1.2, 53.254632916365, 28.130982600076);
  Expect(Fish, -0.4, 0.5, 15.550921937812, 43.964414956621);
  Expect(Fish, 0.8 / 1.2, 0.1 / 1.2, 53.866566245214, 28.132486819684);
}

TEST(CameraModel, UndistortingIsTheWayBack) {
  const CameraModel M{&lenses::OpenCv,
                      {-0.25, 0.05, 0.1, 0.1, 0.01, 0.02, 0.01, 0.005}};
  for (const double R : {0., 0.1, 0.5, 1.}) {
    const double Q = R * R;
    const double Distorted = R * (1 + Q * (-0.25 + Q * (0.05 + Q * 0.01))) /
                             (1 + Q * (0.02 + Q * (0.01 + Q * 0.005)));
    EXPECT_NEAR(M.undistorted(Distorted), R, 1e-12);
  }
  const CameraModel Fold{&lenses::OpenCv, {-0.3}};
  EXPECT_EQ(Fold.undistorted(5), Fold.limit());
}

TEST(CameraModel, DirectionsAreTheWayBack) {
  const CameraModel Models[] = {
      {},
      {&lenses::OpenCv,
       {-0.28, 0.09, 0.002, -0.003, -0.012, 0.03, 0.02, 0.001, 0.004, -0.001,
        0.002, 0.0005}},
      {&lenses::Fisheye, {0.05, -0.01, 0.004, -0.0008}}};
  for (const CameraModel &M : Models)
    for (const double X : {-0.4, 0.0, 0.7})
      for (const double Y : {0.0, 0.5}) {
        const auto [U, V] = M.distorted(X, Y);
        const auto D = M.direction(U, V);
        ASSERT_TRUE(D.has_value());
        EXPECT_NEAR((*D)[0] / (*D)[2], X, 1e-12);
        EXPECT_NEAR((*D)[1] / (*D)[2], Y, 1e-12);
        EXPECT_NEAR(std::hypot((*D)[0], (*D)[1], (*D)[2]), 1, 1e-15);
      }
  // Behind the camera, and where the lens shows nothing.
  const CameraModel Fisheye{&lenses::Fisheye};
  const auto Behind = Fisheye.direction(0, 2.5);
  ASSERT_TRUE(Behind.has_value());
  EXPECT_NEAR((*Behind)[1], std::sin(2.5), 1e-15);
  EXPECT_NEAR((*Behind)[2], std::cos(2.5), 1e-15);
  EXPECT_FALSE(Fisheye.direction(3, 2).has_value());
  const CameraModel Fold{&lenses::OpenCv, {-0.3}};
  EXPECT_FALSE(Fold.direction(0.8, 0).has_value());
}

} // namespace
} // namespace vorion::splat
