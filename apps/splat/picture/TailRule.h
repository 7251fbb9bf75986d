/// When a tile's list goes on in the pixel unit, as --pixel-unit says it.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdint>
#include <string>

namespace vorion::splat {

/// Reasons to hand over; the first that holds decides. None by default.
struct TailRule {
  uint32_t Count = 0;      ///< at most so many entries are left
  float OccludedShare = 0; ///< this share of the pixels is full, (0, 1]
  uint32_t LastOver = 0;   ///< LastOver / LastUnder of the list is left
  uint32_t LastUnder = 1;

  bool any() const { return Count != 0 || OccludedShare > 0 || LastOver != 0; }
  /// The share in the units of vr_tail_share (docs/isa.md).
  uint32_t shareBits() const;
  bool operator==(const TailRule &) const = default;
};

/// Reads "off", or reasons joined by commas: "count:N" (1 to 2^24),
/// "occluded:P" (0 < P <= 1), "last:A/B" (1 <= A <= B <= 255).
Expected<TailRule> parseTailRule(const std::string &Text);

/// What parseTailRule reads.
std::string toString(const TailRule &R);

} // namespace vorion::splat
