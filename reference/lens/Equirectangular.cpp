// The full sphere: longitude and latitude from straight ahead. The Jacobian is
// taken no nearer to a pole than the middle of the picture's last row.
#include "reference/lens/LensModel.h"

#include <cmath>

namespace vorion::reference {
namespace {

struct Equation {
  template <typename T>
  static Place<T> at(const LensCoefficients & /*K*/, const Point<T> &P) {
    using std::atan2;
    using std::sqrt;
    return {atan2(P[0], P[2]), atan2(P[1], T(sqrt(P[0] * P[0] + P[2] * P[2])))};
  }
};

std::optional<glm::dvec3> rayAt(const LensCoefficients & /*K*/,
                                const glm::dvec2 &At) {
  return glm::dvec3(std::sin(At.x) * std::cos(At.y), std::sin(At.y),
                    std::cos(At.x) * std::cos(At.y));
}

template <typename T> Point<T> offPole(const Point<T> &P, int Height) {
  using std::sqrt;
  const double Least = std::sin(M_PI / (2 * Height));
  const T Level = sqrt(P[0] * P[0] + P[2] * P[2]);
  const T Distance = sqrt(P[0] * P[0] + P[1] * P[1] + P[2] * P[2]);
  if (value(Level) >= Least * value(Distance))
    return P;
  const double Up = value(P[1]) < 0 ? -1 : 1;
  const T Vertical = Up * std::sqrt(1 - Least * Least) * Distance;
  // Straight up it looks ahead.
  if (value(Level) == 0)
    return {T(0.), Vertical, Least * Distance};
  const T Out = Least * Distance / Level;
  return {Out * P[0], Vertical, Out * P[2]};
}

} // namespace

const LensModel lenses::Equirectangular =
    withEquation<Equation>({.Name = "EQUIRECTANGULAR",
                            .ByDistance = true,
                            .CoversSphere = true,
                            .Ray = rayAt,
                            .Held = offPole<double>,
                            .HeldWithRows = offPole<Dual<double>>});

} // namespace vorion::reference
