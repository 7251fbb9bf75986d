/// Polynomials of one real variable and the search of roots by bisection, in
/// double precision: what camera models are made of.
#pragma once

#include <span>
#include <vector>

namespace vorion {

/// Coefficients from the constant one on.
using Polynomial = std::vector<double>;

/// The value of \p P at \p X, by Horner's rule; 0 if \p P is empty.
double evaluate(std::span<const double> P, double X);

Polynomial derivative(std::span<const double> P);

/// Neither of them empty.
Polynomial product(std::span<const double> A, std::span<const double> B);

/// Where \p P changes its sign between 0 and \p End, in ascending order, to the
/// last bit.
std::vector<double> signChanges(const Polynomial &P, double End);

/// Bisects [\p Low, \p High]: the place from which on \p Before is false, to
/// the last bit. \p Before is true at Low and changes at most once; if it never
/// does, the result is High.
template <typename Predicate>
double bisect(double Low, double High, const Predicate &Before) {
  // Enough to halve any interval of doubles down to neighbours.
  for (int K = 0; K < 200; ++K) {
    const double Middle = 0.5 * (Low + High);
    (Before(Middle) ? Low : High) = Middle;
  }
  return High;
}

} // namespace vorion
