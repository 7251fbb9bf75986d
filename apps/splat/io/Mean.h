/// The mean of measured values.
#pragma once

#include <numeric>
#include <span>

namespace vorion::splat {

/// Summed in the order of \p Values; NaN if there are none.
inline double meanOf(std::span<const double> Values) {
  return std::accumulate(Values.begin(), Values.end(), 0.0) /
         static_cast<double>(Values.size());
}

} // namespace vorion::splat
