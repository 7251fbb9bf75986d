/// Known depths of a picture, as targets of training.
#pragma once

#include <cstdint>
#include <vector>

namespace vorion::splat {

/// A pixel with a known depth. The device reads it as two words.
struct DepthPoint {
  uint32_t Pixel;  ///< index in row-major order, rows from the top
  float Disparity; ///< 1 / depth, positive and finite

  bool operator==(const DepthPoint &) const = default;
};

/// A term of the loss: \c Weight times the sum over \c Points of the absolute
/// difference between 1 / (expected depth) and \c Disparity.
struct DepthTargets {
  const std::vector<DepthPoint> *Points = nullptr; ///< sorted by pixel; or null
  float Weight = 0;

  bool any() const { return Points && !Points->empty(); }
};

} // namespace vorion::splat
