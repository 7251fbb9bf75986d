#include "vorion/support/Polynomial.h"

#include <utility>

namespace vorion {

double evaluate(std::span<const double> P, double X) {
  double Sum = 0;
  for (std::size_t I = P.size(); I-- > 0;)
    Sum = Sum * X + P[I];
  return Sum;
}

Polynomial derivative(std::span<const double> P) {
  Polynomial D;
  for (std::size_t I = 1; I < P.size(); ++I)
    D.push_back(static_cast<double>(I) * P[I]);
  return D;
}

Polynomial product(std::span<const double> A, std::span<const double> B) {
  Polynomial P(A.size() + B.size() - 1);
  for (std::size_t I = 0; I < A.size(); ++I)
    for (std::size_t J = 0; J < B.size(); ++J)
      P[I + J] += A[I] * B[J];
  return P;
}

// Between two neighbouring sign changes of the derivative there is at most one
// of the polynomial.
std::vector<double> signChanges(const Polynomial &P, double End) {
  if (P.size() < 2)
    return {};
  std::vector<double> Borders = signChanges(derivative(P), End);
  Borders.push_back(End);
  std::vector<double> Found;
  double From = 0;
  for (const double To : Borders) {
    const double Low = std::exchange(From, To);
    const bool Rises = evaluate(P, Low) < 0;
    if (Rises != (evaluate(P, To) < 0))
      Found.push_back(bisect(
          Low, To, [&](double X) { return (evaluate(P, X) < 0) == Rises; }));
  }
  return Found;
}

} // namespace vorion
