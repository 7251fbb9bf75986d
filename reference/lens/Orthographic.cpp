// Parallel rays: x, y.
#include "reference/lens/LensModel.h"

namespace vorion::reference {
namespace {

struct Equation {
  template <typename T>
  static Place<T> at(const LensCoefficients & /*K*/, const Point<T> &P) {
    return {P[0], P[1]};
  }
};

std::optional<glm::dvec3> rayAt(const LensCoefficients & /*K*/,
                                const glm::dvec2 & /*At*/) {
  return glm::dvec3(0, 0, 1);
}

} // namespace

const LensModel lenses::Orthographic = withEquation<Equation>(
    {.Name = "ORTHOGRAPHIC", .IsParallel = true, .Ray = rayAt});

} // namespace vorion::reference
