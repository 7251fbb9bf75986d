/// The mean and the median of measured values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace vorion::splat {

/// Summed in the order of \p Values; NaN if there are none.
inline double meanOf(std::span<const double> Values) {
  return std::accumulate(Values.begin(), Values.end(), 0.0) /
         static_cast<double>(Values.size());
}

/// Of an even number the upper one; there is at least one.
inline double medianOf(std::vector<double> Values) {
  const auto Middle =
      Values.begin() + static_cast<std::ptrdiff_t>(Values.size() / 2);
  std::ranges::nth_element(Values, Middle);
  return *Middle;
}

} // namespace vorion::splat
