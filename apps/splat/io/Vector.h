/// 3D vectors in double precision.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace vorion::splat {

using Vector = std::array<double, 3>;

inline Vector operator+(const Vector &A, const Vector &B) {
  return {A[0] + B[0], A[1] + B[1], A[2] + B[2]};
}
inline Vector operator-(const Vector &A, const Vector &B) {
  return {A[0] - B[0], A[1] - B[1], A[2] - B[2]};
}
inline Vector operator*(double S, const Vector &A) {
  return {S * A[0], S * A[1], S * A[2]};
}
inline double dot(const Vector &A, const Vector &B) {
  return A[0] * B[0] + A[1] * B[1] + A[2] * B[2];
}
inline Vector cross(const Vector &A, const Vector &B) {
  return {A[1] * B[2] - A[2] * B[1], A[2] * B[0] - A[0] * B[2],
          A[0] * B[1] - A[1] * B[0]};
}
inline double length(const Vector &A) { return std::sqrt(dot(A, A)); }
/// Precondition: \p A is not zero.
inline Vector unit(const Vector &A) { return (1 / length(A)) * A; }

/// \p V rotated about the unit vector \p Axis by the angle with this cosine and
/// sine.
inline Vector turned(const Vector &V, const Vector &Axis, double Cos,
                     double Sin) {
  return Cos * V + Sin * cross(Axis, V) + (1 - Cos) * dot(Axis, V) * Axis;
}

/// A unit vector orthogonal to \p A.
inline Vector acrossOf(const Vector &A) {
  std::size_t Least = 0;
  for (std::size_t I = 1; I < 3; ++I)
    if (std::abs(A[I]) < std::abs(A[Least]))
      Least = I;
  Vector Axis{};
  Axis[Least] = 1;
  return unit(cross(A, Axis));
}

} // namespace vorion::splat
