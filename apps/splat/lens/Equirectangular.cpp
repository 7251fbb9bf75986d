// The full sphere: longitude and latitude from straight ahead.

#include "lens/Models.h"

#include <cmath>

namespace vorion::splat {

namespace {

constexpr std::string_view Names[] = {"EQUIRECTANGULAR"};
constexpr std::string_view OtherNames[] = {"SPHERICAL"};
constexpr ColmapLens Colmap[] = {{17, "EQUIRECTANGULAR", 0, 0}};

std::optional<Direction> rayAt(const LensCoefficients & /*K*/, double X,
                               double Y) {
  return Direction{std::sin(X) * std::cos(Y), std::sin(Y),
                   std::cos(X) * std::cos(Y)};
}

/// Beside the ray to its right and down, at right angles to it.
RayFrame frameOnSphere(const Direction & /*Ray*/, double X, double Y) {
  const double SineX = std::sin(X), CosineX = std::cos(X);
  const double SineY = std::sin(Y), CosineY = std::cos(Y);
  return {{{{CosineX, 0, -SineX}, {-SineX * SineY, CosineY, -CosineX * SineY}}},
          {SineX, CosineX, SineY, CosineY},
          {}};
}

/// The cosine of the latitude at which the Jacobian is held: that of the middle
/// of the picture's last row.
double leastCosine(double /*Limit*/, int Height) {
  return std::sin(M_PI / (2 * Height));
}

} // namespace

const LensModel lenses::Equirectangular{
    .Name = "EQUIRECTANGULAR",
    .Names = Names,
    .OtherNames = OtherNames,
    .ViewerName = "equirectangular",
    .Colmap = Colmap,
    .Depth = DepthRule::Distance,
    .CoversSphere = true,
    .EffectName = "equirectangular",
    .EffectText = "two arc tangents, and copies across the seam",
    .Macro = "USE_EQUIRECTANGULAR",
    .Ray = rayAt,
    .Frame = frameOnSphere,
    .KernelLimit = leastCosine};

} // namespace vorion::splat
