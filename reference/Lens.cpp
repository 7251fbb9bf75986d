#include "Lens.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace vorion::reference {
namespace {

/// x/z and y/z that the picture's corners and the middles of its sides see by
/// the radial part.
void setSlopes(Lens &L, const glm::dvec2 &Size, const glm::dvec2 &Focal,
               const glm::dvec2 &Principal) {
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  L.SlopesX = L.SlopesY = {Infinity, -Infinity};
  const double End = std::min(L.Limit, 1e3);
  for (int I = 0; I < 9; ++I) {
    if (I == 4)
      continue;
    const glm::dvec2 At =
        (0.5 * Size * glm::dvec2(I % 3, I / 3) - Principal) / Focal;
    const double Length = std::hypot(At.x, At.y);
    double Low = 0, High = End;
    for (int K = 0; K < 200; ++K)
      (distortedRadius(*L.Model, L.K, (Low + High) / 2).V < Length ? Low
                                                                   : High) =
          (Low + High) / 2;
    const glm::dvec2 Slope = Length > 0 ? At * (High / Length) : At;
    L.SlopesX = {std::min(L.SlopesX[0], Slope.x),
                 std::max(L.SlopesX[1], Slope.x)};
    L.SlopesY = {std::min(L.SlopesY[0], Slope.y),
                 std::max(L.SlopesY[1], Slope.y)};
  }
}

/// \p Z times what lies within the limits of \p Slopes by \p Rule; \p X itself
/// where it does.
template <typename T>
T heldSlope(const T &X, const T &Z, const glm::dvec2 &Slopes, Rules Rule) {
  const double Half = (Slopes[1] - Slopes[0]) / 2;
  const double Low =
      Rule == Rules::Inria ? -1.3 * Half : Slopes[0] - 0.3 * Half;
  const double High =
      Rule == Rules::Inria ? 1.3 * Half : Slopes[1] + 0.3 * Half;
  const double Slope = value(X) / value(Z);
  return Slope < Low ? Low * Z : Slope > High ? High * Z : X;
}

/// Where the Jacobian is taken for a point at \p P.
template <typename Real, typename T>
Point<T> heldPoint(const Camera<Real> &C, const Point<T> &P, Rules Rule) {
  const Lens &L = C.Optics;
  if (L.Model->HoldsSlopes)
    return {heldSlope(P[0], P[2], L.SlopesX, Rule),
            heldSlope(P[1], P[2], L.SlopesY, Rule), P[2]};
  if constexpr (std::is_same_v<T, double>)
    return L.Model->Held(P, C.Height);
  else
    return L.Model->HeldWithRows(P, C.Height);
}

/// Place, with derivatives, of the point that is held for \p P, by \p Rule if
/// any.
template <typename Real, typename T>
Place<Dual<T>> heldPlace(const Camera<Real> &C, const Point<T> &P,
                         std::optional<Rules> Rule) {
  const Point<T> Held = Rule ? heldPoint(C, P, *Rule) : P;
  Point<Dual<T>> Variables;
  for (std::size_t K = 0; K < 3; ++K)
    Variables[K] = Dual<T>::variable(Held[K], K);
  return placeOf(*C.Optics.Model, C.Optics.K, Variables);
}

} // namespace

template <typename Real>
void setLens(Camera<Real> &C, const LensModel &Model,
             const LensCoefficients &K) {
  C.Optics = {&Model, K, Model.Limit(K)};
  if (Model.HoldsSlopes)
    setSlopes(C.Optics, glm::dvec2(C.Width, C.Height), glm::dvec2(C.Focal),
              glm::dvec2(C.Principal));
}

template <typename Real>
bool placeThrough(const Lens &L, const glm::vec<3, Real> &P,
                  glm::vec<2, Real> &At) {
  const Point<double> Seen{double(P.x), double(P.y), double(P.z)};
  if (!L.Model->Sees(L.Limit, Seen))
    return false;
  const Place<double> Found = placeOf(*L.Model, L.K, Seen);
  At = {static_cast<Real>(Found[0]), static_cast<Real>(Found[1])};
  return std::isfinite(At.x) && std::isfinite(At.y);
}

template <typename Real>
LensRows<Real> rowsThrough(const Camera<Real> &C, const glm::vec<3, Real> &P,
                           Rules Rule) {
  const auto At =
      heldPlace<Real, double>(C, {double(P.x), double(P.y), double(P.z)}, Rule);
  LensRows<Real> R;
  for (int K = 0; K < 3; ++K) {
    const auto Of = static_cast<std::size_t>(K);
    R.X[K] = static_cast<Real>(double(C.Focal.x) * At[0].D[Of]);
    R.Y[K] = static_cast<Real>(double(C.Focal.y) * At[1].D[Of]);
  }
  return R;
}

glm::dvec3 backThrough(const Camera<double> &C, const glm::dvec3 &P,
                       std::optional<Rules> Rule, const glm::dvec2 &ByPlace,
                       const LensRows<double> &ByRows) {
  // Straight up or down a longitude has no derivative.
  if (C.Optics.Model->CoversSphere && P.x == 0 && P.z == 0)
    return glm::dvec3(0);
  Point<Dual<double>> Variables;
  for (std::size_t K = 0; K < 3; ++K)
    Variables[K] = Dual<double>::variable(P[static_cast<int>(K)], K);
  const auto Place = placeOf(*C.Optics.Model, C.Optics.K, Variables);
  const auto Held = heldPlace(C, Variables, Rule);
  glm::dvec3 By(0);
  for (std::size_t K = 0; K < 3; ++K) {
    double Sum = C.Focal.x * Place[0].D[K] * ByPlace.x +
                 C.Focal.y * Place[1].D[K] * ByPlace.y;
    for (std::size_t J = 0; J < 3; ++J)
      Sum += C.Focal.x * Held[0].D[J].D[K] * ByRows.X[static_cast<int>(J)] +
             C.Focal.y * Held[1].D[J].D[K] * ByRows.Y[static_cast<int>(J)];
    By[static_cast<int>(K)] = Sum;
  }
  return By;
}

LensRows<double> freeRowsThrough(const Camera<double> &C, const glm::dvec3 &P) {
  const LensRows<double> None{glm::dvec3(0), glm::dvec3(0)};
  return {backThrough(C, P, Rules::Inria, {1, 0}, None),
          backThrough(C, P, Rules::Inria, {0, 1}, None)};
}

template void setLens(Camera<float> &, const LensModel &,
                      const LensCoefficients &);
template void setLens(Camera<double> &, const LensModel &,
                      const LensCoefficients &);
template bool placeThrough(const Lens &, const glm::vec3 &, glm::vec2 &);
template bool placeThrough(const Lens &, const glm::dvec3 &, glm::dvec2 &);
template LensRows<float> rowsThrough(const Camera<float> &, const glm::vec3 &,
                                     Rules);
template LensRows<double> rowsThrough(const Camera<double> &,
                                      const glm::dvec3 &, Rules);

} // namespace vorion::reference
