// Parallel rays: x, y.

#include "lens/Models.h"

namespace vorion::splat {

namespace {

constexpr std::string_view Names[] = {"ORTHOGRAPHIC"};
constexpr std::string_view OtherNames[] = {"ORTHOPHOTO", "ORTHO"};

std::optional<Direction> rayAhead(const LensCoefficients & /*K*/, double /*X*/,
                                  double /*Y*/) {
  return Direction{0, 0, 1};
}

RayFrame frameBesideAxis(const Direction & /*Ray*/, double X, double Y) {
  return {{{{1, 0, 0}, {0, 1, 0}}}, {}, {X, Y}};
}

} // namespace

const LensModel lenses::Orthographic{.Name = "ORTHOGRAPHIC",
                                     .Names = Names,
                                     .OtherNames = OtherNames,
                                     .IsParallel = true,
                                     .EffectName = "orthographic",
                                     .EffectText = "no quotient by the depth",
                                     .Macro = "USE_ORTHOGRAPHIC",
                                     .Ray = rayAhead,
                                     .Frame = frameBesideAxis};

} // namespace vorion::splat
