/// What is known of a picture's depths before it is drawn.
#pragma once

#include <cstdint>
#include <vector>

namespace vorion::splat {

/// A place of which the depth is known. The device reads it as two words.
struct DepthPoint {
  uint32_t Pixel;  ///< rows from the top
  float Disparity; ///< 1 over its depth, positive and finite

  bool operator==(const DepthPoint &) const = default;
};

/// A part of the loss: \c Weight times the sum over \c Points of the absolute
/// difference of 1 over the expected depth there and \c Disparity.
struct DepthTargets {
  const std::vector<DepthPoint> *Points = nullptr; ///< by pixel; or none
  float Weight = 0;

  bool any() const { return Points && !Points->empty(); }
};

} // namespace vorion::splat
