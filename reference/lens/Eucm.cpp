// The enhanced unified camera model (Khomutenko, Garcia and Martinet): x and y
// over alpha rho + (1 - alpha) z, where rho^2 = beta (x^2 + y^2) + z^2.
#include "reference/lens/LensModel.h"

#include <algorithm>
#include <cmath>

namespace vorion::reference {
namespace {

struct Equation {
  template <typename T>
  static Place<T> at(const LensCoefficients &K, const Point<T> &P) {
    using std::sqrt;
    const T Rho = sqrt(K[1] * (P[0] * P[0] + P[1] * P[1]) + P[2] * P[2]);
    const T Divisor = K[0] * Rho + (1 - K[0]) * P[2];
    return {P[0] / Divisor, P[1] / Divisor};
  }
};

/// The point (At, z) whose divisor is 1. The square of alpha rho = 1 -
/// (1 - alpha) z is
///
///     (2 alpha - 1) z^2 + 2 (1 - alpha) z = 1 - alpha^2 beta |At|^2,
///
/// whose root is seen where it is in front of the camera.
std::optional<glm::dvec3> rayAt(const LensCoefficients &K,
                                const glm::dvec2 &At) {
  const double Squared = K[1] * (At.x * At.x + At.y * At.y);
  const double Right = 1 - K[0] * K[0] * Squared;
  if (!(Right > 0))
    return std::nullopt;
  const double Root =
      K[0] * std::sqrt(std::max(0., 1 + (1 - 2 * K[0]) * Squared));
  return glm::dvec3(At, Right / (1 - K[0] + Root));
}

} // namespace

const LensModel lenses::Eucm = withEquation<Equation>(
    {.Name = "EUCM", .HoldsSlopes = true, .Sees = seesInFront, .Ray = rayAt});

} // namespace vorion::reference
