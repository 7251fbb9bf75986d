/// The Pareto front of points that are judged by several figures.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vorion::splat {

/// The points of \p Order, numbers from the best to the worst, that are on the
/// Pareto front: each that none of the front before it beats. \p Beats(A, B)
/// says whether A, which is before B, keeps B off the front. The order is such
/// that no point beats one before it.
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
