/// Internal to the reference: dual numbers with derivatives by three variables.
/// A lens is implemented once, as its formula; its Jacobian and the derivatives
/// of the Jacobian are computed by automatic differentiation.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace vorion::reference {

template <typename T> struct Dual {
  T V{};
  std::array<T, 3> D{};

  Dual() = default;
  Dual(double Value) : V(Value) {}
  Dual(T Value, std::array<T, 3> By) : V(Value), D(By) {}
  /// Variable \p K with the value \p Value.
  static Dual variable(const T &Value, std::size_t K) {
    Dual X;
    X.V = Value;
    X.D[K] = T(1);
    return X;
  }
};

/// F with dF/dV = \p Slope, by the chain rule.
template <typename T>
Dual<T> chained(const Dual<T> &A, const T &Value, const T &Slope) {
  return {Value, {Slope * A.D[0], Slope * A.D[1], Slope * A.D[2]}};
}

template <typename T> Dual<T> operator+(const Dual<T> &A, const Dual<T> &B) {
  return {A.V + B.V, {A.D[0] + B.D[0], A.D[1] + B.D[1], A.D[2] + B.D[2]}};
}
template <typename T> Dual<T> operator-(const Dual<T> &A) {
  return chained(A, -A.V, T(-1));
}
template <typename T> Dual<T> operator-(const Dual<T> &A, const Dual<T> &B) {
  return A + -B;
}
template <typename T> Dual<T> operator*(const Dual<T> &A, const Dual<T> &B) {
  return chained(A, A.V * B.V, B.V) + chained(B, T(0), A.V);
}
template <typename T> Dual<T> operator/(const Dual<T> &A, const Dual<T> &B) {
  const T Q = A.V / B.V;
  return chained(A, Q, T(1) / B.V) + chained(B, T(0), -Q / B.V);
}
template <typename T> Dual<T> operator*(double A, const Dual<T> &B) {
  return Dual<T>(A) * B;
}
template <typename T> Dual<T> operator/(double A, const Dual<T> &B) {
  return Dual<T>(A) / B;
}
template <typename T> Dual<T> operator+(double A, const Dual<T> &B) {
  return Dual<T>(A) + B;
}

template <typename T> Dual<T> sqrt(const Dual<T> &A) {
  using std::sqrt;
  const T Root = sqrt(A.V);
  return chained(A, Root, T(0.5) / Root);
}
template <typename T> Dual<T> atan2(const Dual<T> &Y, const Dual<T> &X) {
  using std::atan2;
  const T Squares = X.V * X.V + Y.V * Y.V;
  return chained(Y, atan2(Y.V, X.V), X.V / Squares) +
         chained(X, T(0), -Y.V / Squares);
}

/// The value without derivatives.
inline double value(double A) { return A; }
inline double value(float A) { return A; }
template <typename T> double value(const Dual<T> &A) { return value(A.V); }

} // namespace vorion::reference
