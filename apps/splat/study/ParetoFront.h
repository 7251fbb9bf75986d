/// The Pareto front of points with several objectives.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vorion::splat {

/// The indices in \p Order of the points on the Pareto front. \p Beats(A, B)
/// returns whether A excludes B, which comes after it, from the front. \p Order
/// is sorted such that no point is excluded by a later one, so each point is
/// compared only with the front before it.
template <typename Relation>
std::vector<std::size_t> paretoFront(const std::vector<std::size_t> &Order,
                                     Relation Beats) {
  std::vector<std::size_t> Front;
  for (const std::size_t Point : Order)
    if (std::ranges::none_of(
            Front, [&](std::size_t Better) { return Beats(Better, Point); }))
      Front.push_back(Point);
  return Front;
}

} // namespace vorion::splat
