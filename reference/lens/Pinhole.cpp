// x/z, y/z. Its Jacobian, also where it is held, is that of Projection.h, whose
// order of operations the device reproduces.
#include "reference/lens/LensModel.h"

namespace vorion::reference {
namespace {

struct Equation {
  template <typename T>
  static Place<T> at(const LensCoefficients & /*K*/, const Point<T> &P) {
    return {P[0] / P[2], P[1] / P[2]};
  }
};

bool inFront(double /*Limit*/, const Point<double> &P) { return P[2] > 0; }

std::optional<glm::dvec3> rayAt(const LensCoefficients & /*K*/,
                                const glm::dvec2 &At) {
  return glm::dvec3(At, 1);
}

} // namespace

const LensModel lenses::Pinhole =
    withEquation<Equation>({.Name = "PINHOLE", .Sees = inFront, .Ray = rayAt});

} // namespace vorion::reference
