/// Rotations as quaternions.
#pragma once

#include <array>

namespace vorion::splat {

using Quaternion = std::array<double, 4>; ///< w, x, y, z

/// The quaternion of the rotation \p R (rows), computed by its largest
/// component; normalized to the accuracy of R.
Quaternion quaternionOf(const std::array<std::array<double, 3>, 3> &R);

} // namespace vorion::splat
