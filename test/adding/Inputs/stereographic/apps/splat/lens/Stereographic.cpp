// A fisheye that keeps angles: 2 tan(t / 2) for the angle t from the axis.

#include "lens/Models.h"

#include <cmath>

namespace vorion::splat {

namespace {

constexpr std::string_view Names[] = {"STEREOGRAPHIC"};

double radius(const LensCoefficients & /*K*/, double Radius) {
  return 2 * std::tan(std::atan(Radius) / 2);
}

std::optional<Direction> rayAt(const LensCoefficients & /*K*/, double X,
                               double Y) {
  const double Q = (X * X + Y * Y) / 4;
  return Direction{X / (1 + Q), Y / (1 + Q), (1 - Q) / (1 + Q)};
}

} // namespace

const LensModel lenses::Stereographic{
    .Name = "STEREOGRAPHIC",
    .Names = Names,
    .Depth = DepthRule::Distance,
    .EffectName = "stereographic",
    .EffectText = "a quotient by the distance plus the depth",
    .Macro = "USE_STEREOGRAPHIC",
    .Radius = radius,
    .Ray = rayAt};

} // namespace vorion::splat
