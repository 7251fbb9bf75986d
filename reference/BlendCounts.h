/// How the work of blending is spread over the pixels of a picture.
#pragma once

#include "Render.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vorion::reference {

struct BlendCounts {
  /// Of each pixel, rows from the top: blended Gaussians, and list entries
  /// that it visits, including the saturating one; 0 where the list is empty.
  std::vector<uint32_t> Blends, Walked;
  /// Blends by alpha: [k] from 255^(-k / Bins) down to the next.
  static constexpr std::size_t Bins = 2048;
  std::array<uint64_t, Bins> ByAlpha{};
  double AlphaSum = 0; ///< of all blends
};

/// Counts as \c blend does, with the same arguments.
BlendCounts countBlends(const std::vector<Splat<float>> &Splats, int Width,
                        int Height, const Options &O);

} // namespace vorion::reference
