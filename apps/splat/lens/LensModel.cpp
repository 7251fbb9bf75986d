#include "lens/LensModel.h"

#include "vorion/support/Polynomial.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorion::splat {

std::string_view anyCoefficients(const LensCoefficients & /*K*/) { return {}; }

double noLimit(const LensCoefficients & /*K*/) {
  return std::numeric_limits<double>::infinity();
}

double sameRadius(const LensCoefficients & /*K*/, double Radius) {
  return Radius;
}

LensPlace distortedRadially(const LensModel &Model, const LensCoefficients &K,
                            double X, double Y) {
  const double R = std::sqrt(X * X + Y * Y);
  const double Scale = R > 0 ? Model.Radius(K, R) / R : 1;
  return {X * Scale, Y * Scale};
}

double asFarAsTheLimit(double Limit) { return Limit; }

std::optional<Direction> rayThroughPlane(const LensCoefficients & /*K*/,
                                         double X, double Y) {
  return directionTo(X, Y);
}

RayFrame frameInPlane(const Direction &Ray, double /*X*/, double /*Y*/) {
  const double A = Ray[0] / Ray[2], B = Ray[1] / Ray[2];
  return {{{{1, 0, -A}, {0, 1, -B}}}, {A, B}, {}};
}

double squaredLimit(double Limit, int /*Height*/) { return Limit * Limit; }

double undistortedRadius(const LensModel &Model, const LensCoefficients &K,
                         double Distorted) {
  return bisect(0, std::min(Model.Limit(K), 1e3),
                [&](double R) { return Model.Radius(K, R) < Distorted; });
}

Direction directionTo(double X, double Y) {
  const double Length = std::hypot(X, Y, 1.0);
  return {X / Length, Y / Length, 1 / Length};
}

} // namespace vorion::splat
