/// Arithmetic whose bits do not depend on the host's math library, whose
/// functions may differ in the last place from version to version.
#pragma once

#include "vorion/support/Hash.h"
#include "vorion/support/SplitMix.h"

#include <cmath>
#include <cstdint>
#include <string_view>

namespace vorion::isasim::stable {

inline double exp(double X) {
  // exp(X) = exp(X / 2^10)^(2^10); the series is exact enough below 2^-4.
  const double Small = X / 1024;
  double Sum = 1;
  for (int N = 12; N > 0; --N)
    Sum = 1 + Small * Sum / N;
  for (int N = 0; N != 10; ++N)
    Sum *= Sum;
  return Sum;
}

/// \p X above 0.
inline double log(double X) {
  int Exponent = 0;
  const double Fraction = std::frexp(X, &Exponent); // exact
  constexpr double Ln2 = 0.69314718055994530942;
  // ln f = 2 artanh((f - 1) / (f + 1)), of at most a third.
  const double T = (Fraction - 1) / (Fraction + 1), T2 = T * T;
  double Sum = 0;
  for (int N = 41; N > 0; N -= 2)
    Sum = Sum * T2 + 1.0 / N;
  return 2 * T * Sum + Exponent * Ln2;
}

inline double pow(double X, double Y) { return exp(Y * log(X)); }

/// The next of a sequence of uniform numbers from 0 to below 1.
inline double nextUniform(uint64_t &State) {
  return static_cast<double>(splitmix::next(State) >> 11) * 0x1p-53;
}

/// A draw of a normal distribution that depends on a name and a number alone:
/// the sum of twelve uniform numbers less 6, whose 5 and 95 % lie 0.2 % off.
inline double normal(std::string_view Name, uint64_t Number) {
  uint64_t State = fnv1a(Name) + Number * 0xd1342543de82ef95;
  double Sum = -6;
  for (int N = 0; N != 12; ++N)
    Sum += nextUniform(State);
  return Sum;
}

/// A number from 0 to below 1 by the same.
inline double uniform(std::string_view Name, uint64_t Number) {
  uint64_t State = fnv1a(Name) + Number * 0xd1342543de82ef95;
  return nextUniform(State);
}

} // namespace vorion::isasim::stable
