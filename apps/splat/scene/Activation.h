/// From stored parameters to the ones that are rendered.
#pragma once

#include "scene/Scene.h"

#include <vector>

namespace vorion::splat {

/// Activated parameters in precision \p Real, laid out as in \c Scene. The
/// quaternions are of unit length: INRIA's rules normalise before the kernel,
/// and gsplat's, which normalise inside, give the same picture. A zero
/// quaternion stays zero, which both treat as no rotation.
template <typename Real> struct Activated {
  std::vector<Real> Scales;    ///< 3 each, standard deviations
  std::vector<Real> Quats;     ///< 4 each: w, x, y, z
  std::vector<Real> Opacities; ///< 1 each, 0 to 1
};

/// Activates \p S. The arithmetic is done in double and rounded once to
/// \p Real, so that every host gives the device the same fp32 bits, and the
/// reference run in fp32 starts from these bits too.
template <typename Real> Activated<Real> activate(const Scene &S);

/// The logit that is activated to \p Opacity (0 to 1), at most 30 either way so
/// that it is finite: from 17 on the opacity is 1 in fp32, and 30 is within
/// 1e-13 of 0 or 1.
float opacityLogit(double Opacity);

extern template Activated<float> activate<float>(const Scene &);
extern template Activated<double> activate<double>(const Scene &);

} // namespace vorion::splat
