/// Distances between points.
#pragma once

#include <cstddef>
#include <vector>

namespace vorion::splat {

/// For each of the points \p Positions (3 floats each), the mean distance to
/// the nearest \p Count others; fewer points than that give the mean over what
/// there is, one point 0. Exact, in double; the result depends on no order.
std::vector<double> meanNeighbourDistances(const std::vector<float> &Positions,
                                           std::size_t Count = 3);

} // namespace vorion::splat
