// Fitzgibbon's division model, with one coefficient: what is shown at the
// distance d from the principal point, a pinhole shows at d / (1 + k d^2).

#include "lens/Models.h"

#include <cmath>
#include <limits>

namespace vorion::splat {

namespace {

constexpr std::string_view Names[] = {"DIVISION", "SIMPLE_DIVISION"};
constexpr ColmapLens Colmap[] = {{12, "SIMPLE_DIVISION", 1, 1},
                                 {13, "DIVISION", 2, 1}};
constexpr std::string_view Keys[] = {"k"};

/// From where on d / (1 + k d^2) comes down again: at d = 1 / sqrt(k).
double limit(const LensCoefficients &K) {
  return K[0] > 0 ? 0.5 / std::sqrt(K[0])
                  : std::numeric_limits<double>::infinity();
}

double radius(const LensCoefficients &K, double R) {
  return 2 * R / (1 + std::sqrt(1 - 4 * K[0] * R * R));
}

/// With a negative k the picture ends where the quotient has its pole.
std::optional<Direction> rayAt(const LensCoefficients &K, double X, double Y) {
  const double Squared = X * X + Y * Y;
  if (!(std::abs(K[0]) * Squared < 1))
    return std::nullopt;
  const double Scale = 1 / (1 + K[0] * Squared);
  return directionTo(X * Scale, Y * Scale);
}

} // namespace

const LensModel lenses::Division{.Name = "DIVISION",
                                 .Names = Names,
                                 .Colmap = Colmap,
                                 .Keys = Keys,
                                 .ListKeys = Keys,
                                 .RadialListKeys = Keys,
                                 .HoldsSlopes = true,
                                 .IsDistortion = true,
                                 .EffectName = "division",
                                 .EffectText = "a distortion by a square root",
                                 .Macro = "USE_DIVISION",
                                 .Limit = limit,
                                 .Radius = radius,
                                 .Ray = rayAt};

} // namespace vorion::splat
