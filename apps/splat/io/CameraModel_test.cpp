// Where camera models end.

#include "io/CameraModel.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace vorion::splat {
namespace {

constexpr double Infinity = std::numeric_limits<double>::infinity();

double openCvLimit(std::array<double, 12> K) {
  return CameraModel{LensModel::OpenCv, K}.limit();
}
double fisheyeLimit(std::array<double, 12> K) {
  return CameraModel{LensModel::Fisheye, K}.limit();
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

TEST(CameraModel, UndistortingIsTheWayBack) {
  const CameraModel M{LensModel::OpenCv,
                      {-0.25, 0.05, 0.1, 0.1, 0.01, 0.02, 0.01, 0.005}};
  for (const double R : {0., 0.1, 0.5, 1.}) {
    const double Q = R * R;
    const double Distorted = R * (1 + Q * (-0.25 + Q * (0.05 + Q * 0.01))) /
                             (1 + Q * (0.02 + Q * (0.01 + Q * 0.005)));
    EXPECT_NEAR(M.undistorted(Distorted), R, 1e-12);
  }
  const CameraModel Fold{LensModel::OpenCv, {-0.3}};
  EXPECT_EQ(Fold.undistorted(5), Fold.limit());
}

} // namespace
} // namespace vorion::splat
