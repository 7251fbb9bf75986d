// OpenCV's fisheye: the angle from the axis times a polynomial of its square.
#include "reference/lens/LensModel.h"

#include <cmath>

namespace vorion::reference {
namespace {

/// The distorted angle over the angle.
template <typename T>
T angleFactor(const LensCoefficients &K, const T &Squared) {
  return 1 + Squared *
                 (K[0] + Squared * (K[1] + Squared * (K[2] + K[3] * Squared)));
}

struct Equation {
  template <typename T>
  static Place<T> at(const LensCoefficients &K, const Point<T> &P) {
    using std::atan2;
    using std::sqrt;
    const T Squared = P[0] * P[0] + P[1] * P[1];
    if (value(Squared) < 1e-8 * value(P[2]) * value(P[2]) && value(P[2]) > 0) {
      // On the axis the root has no derivative; the whole has this series.
      const T Q = Squared / (P[2] * P[2]);
      const T Scale =
          (1 + Q * (K[0] - 1. / 3 + (0.2 - K[0] + K[1]) * Q)) / P[2];
      return {Scale * P[0], Scale * P[1]};
    }
    const T Radius = sqrt(Squared);
    const T Angle = atan2(Radius, P[2]);
    const T Scale = Angle * angleFactor(K, Angle * Angle) / Radius;
    return {Scale * P[0], Scale * P[1]};
  }
};

double limit(const LensCoefficients &K) {
  return firstFailure(M_PI, [&](double Angle) {
    const auto X = Dual<double>::variable(Angle, 0);
    return (X * angleFactor(K, X * X)).D[0] > 0;
  });
}

bool withinAngle(double Limit, const Point<double> &P) {
  return std::atan2(std::hypot(P[0], P[1]), P[2]) < Limit;
}

} // namespace

const LensModel lenses::Fisheye =
    withEquation<Equation>({.Name = "OPENCV_FISHEYE",
                            .ByDistance = true,
                            .Limit = limit,
                            .Sees = withinAngle});

} // namespace vorion::reference
