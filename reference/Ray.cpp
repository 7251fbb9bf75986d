#include "Ray.h"

#include "Shutter.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace vorion::reference {
namespace {

/// The place through the radial part of \p L at \p Angle from the axis.
double radialPlace(const Lens &L, double Angle) {
  Lens Radial = L;
  Radial.K = L.Model->RadialPart(L.K);
  glm::dvec2 At;
  const glm::dvec3 P(std::sin(Angle), 0, std::cos(Angle));
  return placeThrough(Radial, P, At) ? At.x : INFINITY;
}

/// The direction whose place through the radial part is \p At. That grows up to
/// the model's limit, so halving finds it.
glm::dvec3 radialDirection(const Lens &L, const glm::dvec2 &At) {
  const double Length = glm::length(At);
  if (Length == 0)
    return {0, 0, 1};
  double Low = 0, High = L.byDistance() ? L.Limit : std::atan(L.Limit);
  for (int I = 0; I < 100; ++I) {
    const double Middle = (Low + High) / 2;
    (radialPlace(L, Middle) < Length ? Low : High) = Middle;
  }
  return {At / Length * std::sin(Low), std::cos(Low)};
}

/// \p D, whose place is near \p At, by Newton's steps of its slopes to the
/// direction whose place that is.
void refine(const Camera<double> &C, const glm::dvec2 &At, glm::dvec3 &D) {
  for (int I = 0; I < 30; ++I) {
    D /= D.z;
    glm::dvec2 Place;
    if (!placeThrough(C.Optics, D, Place))
      return;
    const LensRows<double> J = freeRowsThrough(C, D);
    const glm::dvec2 Off = C.Focal * (At - Place);
    const double Det = J.X.x * J.Y.y - J.X.y * J.Y.x;
    D.x += (J.Y.y * Off.x - J.X.y * Off.y) / Det;
    D.y += (J.X.x * Off.y - J.Y.x * Off.x) / Det;
  }
}

/// The direction that the lens shows at \p At, in units of the focal lengths.
std::optional<glm::dvec3> directionAt(const Camera<double> &C,
                                      const glm::dvec2 &At) {
  const LensModel &Model = *C.Optics.Model;
  if (Model.Ray)
    return Model.Ray(C.Optics.K, At);
  glm::dvec3 D = radialDirection(C.Optics, At);
  if (Model.RadialPart != allRadial)
    refine(C, At, D);
  glm::dvec2 Place;
  if (!placeThrough(C.Optics, D, Place) ||
      !(glm::length(Place - At) < 1e-9 * (1 + glm::length(At))))
    return std::nullopt;
  return D;
}

} // namespace

std::optional<PixelRay> rayAt(const Camera<double> &C, const glm::dvec2 &At) {
  const glm::dvec2 Place = (At - C.Principal) / C.Focal;
  const auto Own = directionAt(C, Place);
  if (!Own)
    return std::nullopt;
  const glm::dvec3 D =
      *Own / (C.Optics.byDistance() ? glm::length(*Own) : Own->z);
  PixelRay R;
  R.Eye = glm::dvec3(0);
  R.Origin = C.Optics.Model->IsParallel ? glm::dvec3(Place, 0) : glm::dvec3(0);
  R.Direction = glm::normalize(D);
  R.Ahead = {0, 0, 1};
  R.Rows = freeRowsThrough(C, D);
  if (!C.Shutter)
    return R;
  const RollingShutter &S = *C.Shutter;
  const double Moment = momentAt(C, At);
  R.Eye = Moment * S.Motion;
  R.Origin = R.Eye + turned(S.Turn, Moment, R.Origin);
  for (glm::dvec3 *V : {&R.Direction, &R.Ahead, &R.Rows.X, &R.Rows.Y})
    *V = turned(S.Turn, Moment, *V);
  return R;
}

} // namespace vorion::reference
