// A fisheye that keeps angles: 2 tan(t / 2) for the angle t from the axis.
#include "reference/lens/LensModel.h"

#include <cmath>

namespace vorion::reference {
namespace {

struct Equation {
  template <typename T>
  static Place<T> at(const LensCoefficients & /*K*/, const Point<T> &P) {
    using std::sqrt;
    const T Distance = sqrt(P[0] * P[0] + P[1] * P[1] + P[2] * P[2]);
    const T Scale = 2 / (Distance + P[2]);
    return {Scale * P[0], Scale * P[1]};
  }
};

std::optional<glm::dvec3> rayAt(const LensCoefficients & /*K*/,
                                const glm::dvec2 &At) {
  const double Q = (At.x * At.x + At.y * At.y) / 4;
  return glm::dvec3(At, 1 - Q);
}

} // namespace

const LensModel lenses::Stereographic = withEquation<Equation>(
    {.Name = "STEREOGRAPHIC", .ByDistance = true, .Ray = rayAt});

} // namespace vorion::reference
