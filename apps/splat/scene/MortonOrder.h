/// Gaussians that are neighbours in space as neighbours in memory.
#pragma once

#include "scene/Scene.h"

#include <cstddef>

namespace vorion::splat {

/// Puts the Gaussians of \p S in the order of their means along a Morton curve
/// (Z-order curve), and gives how many are in another place then. The curve
/// goes through a cube around all means, in 2^21 steps an axis. x changes
/// fastest. Means of one step keep their order, so that a second call changes
/// nothing. All means are finite.
std::size_t putInMortonOrder(Scene &S);

} // namespace vorion::splat
