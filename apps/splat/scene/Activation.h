/// Activation of stored parameters.
#pragma once

#include "scene/Scene.h"

#include <cmath>
#include <limits>
#include <vector>

namespace vorion::splat {

/// Activated parameters in precision \p Real, laid out as in \c Scene.
/// Quaternions are normalized: INRIA's rules normalize before the kernel, and
/// gsplat's, which normalize inside, give the same picture. A zero quaternion
/// remains zero, which both treat as the identity.
template <typename Real> struct Activated {
  std::vector<Real> Scales;    ///< 3 each, standard deviations
  std::vector<Real> Quats;     ///< 4 each: w, x, y, z
  std::vector<Real> Opacities; ///< 1 each, 0 to 1
};

/// Activates \p S. Computed in double and rounded once to \p Real, so that the
/// fp32 inputs of the device are the same on every host and equal those of the
/// fp32 reference.
template <typename Real> Activated<Real> activate(const Scene &S);

/// The logit that is activated to \p Opacity (0 to 1), at most 30 either way so
/// that it is finite: from 17 on the opacity is 1 in fp32, and 30 is within
/// 1e-13 of 0 or 1.
float opacityLogit(double Opacity);

/// Replaces the infinities of \p S that have a meaning by finite values of the
/// same picture: a logit of +infinity (opaque) and of -infinity (absent) by
/// those of opacityLogit(), a log scale of -infinity (flat) by that of the
/// smallest normal float.
void resolveInfinities(Scene &S);

/// The logarithm of a scale that is none: of the least normal float.
inline const float FlatLogScale = std::log(std::numeric_limits<float>::min());

/// Takes its smallest scale from each Gaussian, of equal ones the last.
void flatten(Scene &S);

extern template Activated<float> activate<float>(const Scene &);
extern template Activated<double> activate<double>(const Scene &);

} // namespace vorion::splat
