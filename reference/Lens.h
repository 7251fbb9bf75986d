/// From a point in the camera's axes to its place on the picture, by the
/// camera's model. All of it is computed in double precision, also for a
/// reference in fp32, whose bits the device need not give here.
#pragma once

#include "Types.h"

#include <cmath>
#include <optional>

namespace vorion::reference {

/// Gives \p C the model with its coefficients and computes its limits. Size,
/// focal lengths and principal point must be there.
template <typename Real>
void setLens(Camera<Real> &C, const LensModel &Model,
             const LensCoefficients &K);

/// The place of \p P in units of the focal lengths, from the principal point;
/// false if the model does not say one: behind a camera that looks forward, or
/// beyond its limit.
template <typename Real>
bool placeThrough(const Lens &L, const glm::vec<3, Real> &P,
                  glm::vec<2, Real> &At);

/// The difference of two such places; of longitudes the shorter way round.
template <typename Real>
glm::vec<2, Real> placeDifference(const Lens &L, const glm::vec<2, Real> &A,
                                  const glm::vec<2, Real> &B) {
  glm::vec<2, Real> D = A - B;
  if (L.Model->CoversSphere)
    D.x -= static_cast<Real>(2 * M_PI) *
           std::round(D.x / static_cast<Real>(2 * M_PI));
  return D;
}

/// Rows of the Jacobian of that in pixels. It is taken at \p P, or where the
/// model holds it: at slopes within the limits of \p Rule, or where its own
/// file says.
template <typename Real> struct LensRows {
  glm::vec<3, Real> X, Y;
};
template <typename Real>
LensRows<Real> rowsThrough(const Camera<Real> &C, const glm::vec<3, Real> &P,
                           Rules Rule);

/// The same at \p P itself.
LensRows<double> freeRowsThrough(const Camera<double> &C, const glm::dvec3 &P);

/// dL/dP from dL/d(place in pixels) and dL/d(rows), held by \p Rule if any.
glm::dvec3 backThrough(const Camera<double> &C, const glm::dvec3 &P,
                       std::optional<Rules> Rule, const glm::dvec2 &ByPlace,
                       const LensRows<double> &ByRows);

} // namespace vorion::reference
