#include "Lens.h"

#include "Dual.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace vorion::reference {
namespace {

/// A point or a place of any kind of number.
template <typename T> using Point = std::array<T, 3>;
template <typename T> using Place = std::array<T, 2>;

template <typename T>
Place<T> throughOpenCv(const LensCoefficients &K, const Point<T> &P) {
  const T A = P[0] / P[2], B = P[1] / P[2], Q = A * A + B * B;
  const T Radial = (1 + Q * (K[0] + Q * (K[1] + Q * (K[4] + K[12] * Q)))) /
                   (1 + Q * (K[5] + Q * (K[6] + K[7] * Q)));
  return {A * Radial + 2 * K[2] * (A * B) + K[3] * (Q + 2 * (A * A)) +
              Q * (K[8] + K[9] * Q),
          B * Radial + K[2] * (Q + 2 * (B * B)) + 2 * K[3] * (A * B) +
              Q * (K[10] + K[11] * Q)};
}

/// The distorted angle over the angle.
template <typename T>
T angleFactor(const LensCoefficients &K, const T &Squared) {
  return 1 + Squared *
                 (K[0] + Squared * (K[1] + Squared * (K[2] + K[3] * Squared)));
}

template <typename T>
Place<T> throughFisheye(const LensCoefficients &K, const Point<T> &P) {
  using std::atan2;
  using std::sqrt;
  const T Squared = P[0] * P[0] + P[1] * P[1];
  if (value(Squared) < 1e-8 * value(P[2]) * value(P[2]) && value(P[2]) > 0) {
    // On the axis the root has no derivative; the whole has this series.
    const T Q = Squared / (P[2] * P[2]);
    const T Scale = (1 + Q * (K[0] - 1. / 3 + (0.2 - K[0] + K[1]) * Q)) / P[2];
    return {Scale * P[0], Scale * P[1]};
  }
  const T Radius = sqrt(Squared);
  const T Angle = atan2(Radius, P[2]);
  const T Scale = Angle * angleFactor(K, Angle * Angle) / Radius;
  return {Scale * P[0], Scale * P[1]};
}

template <typename T> Place<T> through(const Lens &L, const Point<T> &P) {
  using std::atan2;
  using std::sqrt;
  switch (L.Model) {
  case LensModel::Pinhole:
    break;
  case LensModel::OpenCv:
    return throughOpenCv(L.K, P);
  case LensModel::Fisheye:
    return throughFisheye(L.K, P);
  case LensModel::Orthographic:
    return {P[0], P[1]};
  case LensModel::Equirectangular:
    return {atan2(P[0], P[2]), atan2(P[1], T(sqrt(P[0] * P[0] + P[2] * P[2])))};
  }
  return {P[0] / P[2], P[1] / P[2]};
}

/// The first of so many equal steps to \p End after which \p Good is false,
/// halved until it stands still; \p End if there is none.
double firstFailure(double End, const std::function<bool(double)> &Good) {
  constexpr int Steps = 20000;
  for (int I = 1; I <= Steps; ++I) {
    double Low = End * (I - 1) / Steps, High = End * I / Steps;
    if (Good(High))
      continue;
    for (int K = 0; K < 60; ++K)
      (Good((Low + High) / 2) ? Low : High) = (Low + High) / 2;
    return High;
  }
  return End;
}

/// The distorted radius of one before distortion, with its derivative.
Dual<double> distorted(const LensCoefficients &K, double Radius) {
  LensCoefficients Radial = K;
  for (const int Other : {2, 3, 8, 9, 10, 11})
    Radial[static_cast<std::size_t>(Other)] = 0;
  return throughOpenCv<Dual<double>>(
      Radial, {Dual<double>::variable(Radius, 0), 0., 1.})[0];
}

/// Up to where the radial part grows without a pole.
double openCvLimit(const LensCoefficients &K) {
  const auto Grows = [&](double Angle) {
    const double R = std::tan(Angle), Q = R * R;
    return distorted(K, R).D[0] > 0 &&
           1 + Q * (K[5] + Q * (K[6] + K[7] * Q)) > 0;
  };
  // Up to a slope of 10^4; the right angle itself has none.
  const double End = std::atan(1e4), Angle = firstFailure(End, Grows);
  return Angle < End ? std::tan(Angle)
                     : std::numeric_limits<double>::infinity();
}

double fisheyeLimit(const LensCoefficients &K) {
  return firstFailure(M_PI, [&](double Angle) {
    const auto X = Dual<double>::variable(Angle, 0);
    return (X * angleFactor(K, X * X)).D[0] > 0;
  });
}

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
      (distorted(L.K, (Low + High) / 2).V < Length ? Low : High) =
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
  using std::sqrt;
  const Lens &L = C.Optics;
  if (L.Model == LensModel::OpenCv)
    return {heldSlope(P[0], P[2], L.SlopesX, Rule),
            heldSlope(P[1], P[2], L.SlopesY, Rule), P[2]};
  if (L.Model != LensModel::Equirectangular)
    return P;
  const double Least = std::sin(M_PI / (2 * C.Height));
  const T Level = sqrt(P[0] * P[0] + P[2] * P[2]);
  const T Distance = sqrt(P[0] * P[0] + P[1] * P[1] + P[2] * P[2]);
  if (value(Level) >= Least * value(Distance))
    return P;
  const double Up = value(P[1]) < 0 ? -1 : 1;
  const T Height = Up * std::sqrt(1 - Least * Least) * Distance;
  // Straight up it looks ahead.
  if (value(Level) == 0)
    return {T(0.), Height, Least * Distance};
  const T Out = Least * Distance / Level;
  return {Out * P[0], Height, Out * P[2]};
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
  return through(C.Optics, Variables);
}

} // namespace

template <typename Real>
void setLens(Camera<Real> &C, LensModel Model, const LensCoefficients &K) {
  C.Optics = {Model, K, std::numeric_limits<double>::infinity()};
  if (Model == LensModel::Fisheye)
    C.Optics.Limit = fisheyeLimit(K);
  if (Model != LensModel::OpenCv)
    return;
  C.Optics.Limit = openCvLimit(K);
  setSlopes(C.Optics, glm::dvec2(C.Width, C.Height), glm::dvec2(C.Focal),
            glm::dvec2(C.Principal));
}

template <typename Real>
bool placeThrough(const Lens &L, const glm::vec<3, Real> &P,
                  glm::vec<2, Real> &At) {
  const auto X = double(P.x), Y = double(P.y), Z = double(P.z);
  if (L.Model == LensModel::Pinhole && !(Z > 0))
    return false;
  if (L.Model == LensModel::OpenCv &&
      !(Z > 0 && std::hypot(X, Y) < L.Limit * Z))
    return false;
  if (L.Model == LensModel::Fisheye &&
      !(std::atan2(std::hypot(X, Y), Z) < L.Limit))
    return false;
  const Place<double> Found = through<double>(L, {X, Y, Z});
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
  if (C.Optics.Model == LensModel::Equirectangular && P.x == 0 && P.z == 0)
    return glm::dvec3(0);
  Point<Dual<double>> Variables;
  for (std::size_t K = 0; K < 3; ++K)
    Variables[K] = Dual<double>::variable(P[static_cast<int>(K)], K);
  const auto Place = through(C.Optics, Variables);
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

template void setLens(Camera<float> &, LensModel, const LensCoefficients &);
template void setLens(Camera<double> &, LensModel, const LensCoefficients &);
template bool placeThrough(const Lens &, const glm::vec3 &, glm::vec2 &);
template bool placeThrough(const Lens &, const glm::dvec3 &, glm::dvec2 &);
template LensRows<float> rowsThrough(const Camera<float> &, const glm::vec3 &,
                                     Rules);
template LensRows<double> rowsThrough(const Camera<double> &,
                                      const glm::dvec3 &, Rules);

} // namespace vorion::reference
