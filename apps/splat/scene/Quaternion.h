/// Rotations as quaternions.
#pragma once

#include <array>

namespace vorion::splat {

using Quaternion = std::array<double, 4>; ///< w, x, y, z

/// Of the rotation \p R (rows), by its largest component; of length 1 as far
/// as R's rows are.
Quaternion quaternionOf(const std::array<std::array<double, 3>, 3> &R);

} // namespace vorion::splat
