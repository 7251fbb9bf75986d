#include "scene/Selection.h"

#include "scene/Activation.h"

#include <algorithm>
#include <cstddef>

namespace vorion::splat {

/// Those for whose index \p Holds is true.
template <typename Rule>
static Selection where(const Scene &S, const Rule &Holds) {
  Selection Of(S.size());
  for (std::size_t I = 0; I < S.size(); ++I)
    Of[I] = Holds(I);
  return Of;
}

Selection inBox(const Scene &S, const std::array<double, 6> &Corners) {
  return where(S, [&](std::size_t I) {
    bool Inside = true;
    for (std::size_t A = 0; A < 3; ++A)
      Inside = Inside && S.mean(3 * I + A) >= Corners[A] &&
               S.mean(3 * I + A) <= Corners[A + 3];
    return Inside;
  });
}

Selection inSphere(const Scene &S, const std::array<double, 4> &Sphere) {
  return where(S, [&](std::size_t I) {
    double Squares = 0;
    for (std::size_t A = 0; A < 3; ++A) {
      const double D = S.mean(3 * I + A) - Sphere[A];
      Squares += D * D;
    }
    return Squares <= Sphere[3] * Sphere[3];
  });
}

Selection fainterThan(const Scene &S, double Opacity) {
  const auto Of = activate<double>(S);
  return where(S, [&](std::size_t I) { return Of.Opacities[I] < Opacity; });
}

Selection largerThan(const Scene &S, double Deviation) {
  const auto Of = activate<double>(S);
  return where(S, [&](std::size_t I) {
    const double *Scales = &Of.Scales[3 * I];
    return std::max({Scales[0], Scales[1], Scales[2]}) > Deviation;
  });
}

} // namespace vorion::splat
