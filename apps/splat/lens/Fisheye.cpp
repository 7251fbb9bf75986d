// OpenCV's fisheye: a point at the angle t from the axis is seen at the
// distance t (1 + k1 t^2 + k2 t^4 + k3 t^6 + k4 t^8) from the principal point.

#include "lens/Models.h"
#include "vorion/support/Polynomial.h"

#include <cmath>
#include <limits>

namespace vorion::splat {

namespace {

constexpr std::string_view Names[] = {"OPENCV_FISHEYE", "SIMPLE_RADIAL_FISHEYE",
                                      "RADIAL_FISHEYE"};
constexpr std::string_view OtherNames[] = {"FISHEYE", "SIMPLE_FISHEYE"};
constexpr ColmapLens Colmap[] = {{5, "OPENCV_FISHEYE", 2, 4},
                                 {8, "SIMPLE_RADIAL_FISHEYE", 1, 1},
                                 {9, "RADIAL_FISHEYE", 1, 2},
                                 {14, "SIMPLE_FISHEYE", 1, 0},
                                 {15, "FISHEYE", 2, 0}};
constexpr std::string_view Keys[] = {"k1", "k2", "k3", "k4"};

/// How far from the principal point what is at \p Angle from the axis is shown.
double placeOf(const LensCoefficients &K, double Angle) {
  const double Factor[] = {1, K[0], K[1], K[2], K[3]};
  return Angle * evaluate(Factor, Angle * Angle);
}

/// The angle at which the distorted one turns back, at most pi.
double limit(const LensCoefficients &K) {
  const Polynomial Slope{1, 3 * K[0], 5 * K[1], 7 * K[2], 9 * K[3]};
  const auto Zeros = signChanges(Slope, M_PI * M_PI);
  return Zeros.empty() ? M_PI : std::sqrt(Zeros.front());
}

double radius(const LensCoefficients &K, double Radius) {
  return placeOf(K, std::atan(Radius));
}

/// What is beside the camera and behind it no pinhole shows.
double reach(double Limit) {
  return Limit < M_PI / 2 ? std::tan(Limit)
                          : std::numeric_limits<double>::infinity();
}

/// The distorted angle grows up to the limit.
std::optional<Direction> rayAt(const LensCoefficients &K, double X, double Y) {
  const double Distance = std::hypot(X, Y);
  if (!(Distance < placeOf(K, limit(K))))
    return std::nullopt;
  const double Angle =
      bisect(0, limit(K), [&](double A) { return placeOf(K, A) < Distance; });
  const double Across = Distance > 0 ? std::sin(Angle) / Distance : 0;
  return Direction{X * Across, Y * Across, std::cos(Angle)};
}

/// Beside the ray outward, by a greater angle, and around the axis.
RayFrame frameAroundAxis(const Direction &Ray, double /*X*/, double /*Y*/) {
  const auto [X, Y, Z] = Ray;
  const double Sine = std::hypot(X, Y);
  const double Out[2] = {Sine > 0 ? X / Sine : 1, Sine > 0 ? Y / Sine : 0};
  return {{{{Out[0] * Z, Out[1] * Z, -Sine}, {-Out[1], Out[0], 0}}},
          {std::atan2(Sine, Z), Z, Sine, Out[0], Out[1]},
          {}};
}

double asAngle(double Limit, int /*Height*/) { return Limit; }

} // namespace

const LensModel lenses::Fisheye{
    .Name = "OPENCV_FISHEYE",
    .Names = Names,
    .OtherNames = OtherNames,
    .Flag = "is_fisheye",
    .ViewerName = "fisheye",
    .Colmap = Colmap,
    .Keys = Keys,
    .ListKeys = Keys,
    .RadialListKeys = Keys,
    .Depth = DepthRule::Distance,
    .EffectName = "fisheye",
    .EffectText = "an arc tangent and a polynomial of the angle",
    .Macro = "USE_FISHEYE",
    .Limit = limit,
    .Radius = radius,
    .Reach = reach,
    .Ray = rayAt,
    .Frame = frameAroundAxis,
    .KernelLimit = asAngle};

} // namespace vorion::splat
