/// Spatial sorting of Gaussians for locality in memory.
#pragma once

#include "scene/Scene.h"

#include <cstddef>

namespace vorion::splat {

/// Sorts the Gaussians of \p S by the Morton codes (Z-order curve) of their
/// means, and returns the number of Gaussians whose index changed. The curve
/// fills the bounding cube of all means, with 2^21 steps per axis; x is the
/// least significant. The sort is stable, so that a second call changes
/// nothing. All means must be finite.
std::size_t putInMortonOrder(Scene &S);

} // namespace vorion::splat
