// The enhanced unified camera model, with two coefficients: a point is divided
// by alpha sqrt(beta (x^2 + y^2) + z^2) + (1 - alpha) z instead of by z.

#include "lens/Models.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {

namespace {

constexpr std::string_view Names[] = {"EUCM"};
constexpr ColmapLens Colmap[] = {{16, "EUCM", 2, 2}};
constexpr std::string_view Keys[] = {"alpha", "beta"};

/// Without coefficients it is a pinhole.
std::string_view expected(const LensCoefficients &K) {
  const bool IsPinhole = K[0] == 0 && K[1] == 0;
  return IsPinhole || (K[0] >= 0 && K[0] <= 1 && K[1] > 0)
             ? ""
             : "alpha from 0 to 1 and beta above 0";
}

double radius(const LensCoefficients &K, double R) {
  return R / (K[0] * std::sqrt(1 + K[1] * R * R) + 1 - K[0]);
}

/// The point whose divisor is 1. Its z falls to 0 at the radius
/// 1 / (alpha sqrt(beta)), where the picture ends.
std::optional<Direction> rayAt(const LensCoefficients &K, double X, double Y) {
  const double Alpha = K[0], Squared = K[1] * (X * X + Y * Y);
  const double Rest = 1 - Alpha * Alpha * Squared;
  if (!(Rest > 0))
    return std::nullopt;
  // Above 0 where Rest is, but for rounding.
  const double Root = std::sqrt(std::max(1 - (2 * Alpha - 1) * Squared, 0.0));
  const double Scale = (Alpha * Root + 1 - Alpha) / Rest;
  return directionTo(X * Scale, Y * Scale);
}

} // namespace

const LensModel lenses::Eucm{.Name = "EUCM",
                             .Names = Names,
                             .Colmap = Colmap,
                             .Keys = Keys,
                             .ListKeys = Keys,
                             .RadialListKeys = Keys,
                             .HoldsSlopes = true,
                             .IsDistortion = true,
                             .EffectName = "eucm",
                             .EffectText =
                                 "a quotient by a root plus the depth",
                             .Macro = "USE_EUCM",
                             .ExpectedCoefficients = expected,
                             .Radius = radius,
                             .Ray = rayAt};

} // namespace vorion::splat
