// Fitzgibbon's division model: a pinhole shows at d / (1 + k d^2) what it shows
// at d. Solved for d, with q = (x^2 + y^2) / z^2: both coordinates times
// 2 / (1 + sqrt(1 - 4 k q)).
#include "reference/lens/LensModel.h"

#include <cmath>

namespace vorion::reference {
namespace {

struct Equation {
  template <typename T>
  static Place<T> at(const LensCoefficients &K, const Point<T> &P) {
    using std::sqrt;
    const T A = P[0] / P[2], B = P[1] / P[2];
    const T Root = sqrt(1 + -4 * K[0] * (A * A + B * B));
    const T Scale = 2 / (1 + Root);
    return {A * Scale, B * Scale};
  }
};

double limit(const LensCoefficients &K) {
  return K[0] > 0 ? 0.5 / std::sqrt(K[0])
                  : std::numeric_limits<double>::infinity();
}

std::optional<glm::dvec3> rayAt(const LensCoefficients &K,
                                const glm::dvec2 &At) {
  const double Squared = At.x * At.x + At.y * At.y;
  if (!(std::abs(K[0]) * Squared < 1))
    return std::nullopt;
  return glm::dvec3(At, 1 + K[0] * Squared);
}

} // namespace

const LensModel lenses::Division = withEquation<Equation>({.Name = "DIVISION",
                                                           .HoldsSlopes = true,
                                                           .Limit = limit,
                                                           .Sees = seesInFront,
                                                           .Ray = rayAt});

} // namespace vorion::reference
