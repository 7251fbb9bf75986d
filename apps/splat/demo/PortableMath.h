/// Functions of real numbers by additions, multiplications and square roots
/// alone, so that a scene has the same bits on every host: a C library's may
/// differ in the last bit.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace vorion::splat::demo {

/// e^X, for |X| up to 700.
inline double portableExp(double X) {
  const double Twos = std::floor(X * std::numbers::log2e + 0.5);
  const double R = X - Twos * std::numbers::ln2;
  double Sum = 1;
  for (int K = 14; K > 0; --K)
    Sum = 1 + Sum * R / K;
  return std::ldexp(Sum, static_cast<int>(Twos));
}

/// The natural logarithm of X > 0.
inline double portableLog(double X) {
  int Twos = 0;
  double M = std::frexp(X, &Twos);
  if (M < std::numbers::sqrt2 / 2) {
    M *= 2;
    --Twos;
  }
  // 2 artanh(Q) of |Q| below 0.172.
  const double Q = (M - 1) / (M + 1);
  double Sum = 0;
  for (int K = 21; K > 0; K -= 2)
    Sum = Sum * Q * Q + 1.0 / K;
  return 2 * Q * Sum + Twos * std::numbers::ln2;
}

inline double portablePower(double Base, double Exponent) {
  return portableExp(Exponent * portableLog(Base));
}

/// Cosine and sine of \p Turns full turns.
inline std::pair<double, double> portableCosSin(double Turns) {
  const double Quarters = std::floor(4 * Turns + 0.5);
  const double A = 2 * std::numbers::pi * (Turns - Quarters / 4);
  double C = 1, S = 1;
  for (int K = 14; K > 0; K -= 2) {
    C = 1 - C * A * A / (K * (K - 1));
    S = 1 - S * A * A / (K * (K + 1));
  }
  S *= A;
  switch (static_cast<int64_t>(Quarters) & 3) {
  case 0:
    return {C, S};
  case 1:
    return {-S, C};
  case 2:
    return {-C, -S};
  default:
    return {S, -C};
  }
}

} // namespace vorion::splat::demo
