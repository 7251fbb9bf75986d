/// Distances between points.
#pragma once

#include <cstddef>
#include <vector>

namespace vorion::splat {

/// For each of the points \p Positions (3 floats each), the mean distance to
/// the nearest \p Count others, or to all others if there are fewer; 0 for a
/// single point. Exact, in double precision, and independent of the order of
/// points.
std::vector<double> meanNeighbourDistances(const std::vector<float> &Positions,
                                           std::size_t Count = 3);

} // namespace vorion::splat
