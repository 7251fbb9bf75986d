/// What every scene that a reader gives fulfils.
#pragma once

#include "scene/SceneFile.h"

namespace vorion::splat::testing {

/// Whether arrays and degree of \p S belong together, there is a Gaussian, and
/// all values are finite.
inline bool isWhole(const Scene &S) {
  const std::size_t Count = S.size();
  return Count > 0 && S.ShDegree >= 0 && S.ShDegree <= MaxShDegree &&
         S.Means.size() == 3 * Count && S.LogScales.size() == 3 * Count &&
         S.Quats.size() == 4 * Count &&
         S.Sh.size() == 3 * S.coefficients() * Count &&
         static_cast<bool>(checkFinite("", S));
}

} // namespace vorion::splat::testing
