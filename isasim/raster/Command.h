/// What a Raster Agent hands to its rasterizer, and what comes back.
#pragma once

#include "raster/RasterTables.h"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace vorion::raster {

/// The configuration bank at the write of vr_start, as written: checkCommand()
/// reads and judges it (Job.h).
struct Command : BankWords {
  std::vector<Gaussian> Pushed; ///< descriptors of mode "pushed", in order
  bool PushOverflowed = false;  ///< some did not fit the push buffer

  bool isBackward() const { return ModeBackward.get(Mode) != 0; }
  /// Whether its core takes batches, and its end, with vr_grad_next.
  bool handsOver() const {
    return isBackward() || ModeFragments.get(Mode) != 0;
  }
};

class RasterAgent;

/// A hand-over: whose command goes on, the address of its vx_tail, and whether
/// a vx_tail_range follows that.
struct HandOver {
  RasterAgent *Agent;
  uint32_t Record;
  bool HasRange;
};

/// A pixel as it leaves the rasterizer; the background is not applied.
struct Pixel {
  float R = 0, G = 0, B = 0;
  float T = 0; ///< transmittance

  bool operator==(const Pixel &) const = default;
};
static_assert(sizeof(Pixel) == 16, "docs/abi.md: four floats a pixel");

/// What a Gaussian is handed over with: the words of vr_grad_tag to _syy, and
/// those that only rays have.
struct GradientSums {
  uint32_t Tag = 0;
  /// dL/dr, dL/dg, dL/db; s, s dx, s dy, s dx dx, s dx dy, s dy dy; and of
  /// rays, whose other sums docs/abi.md has, three more, five with a low pass.
  std::array<float, 14> Sums{};

  bool operator==(const GradientSums &) const = default;
};

/// A fragment that is handed over: the words VR_ITEM_*.
struct Fragment {
  uint32_t Primitive; ///< tag of its triangle
  uint32_t Pixel;     ///< column of the picture, and row times 2^16
  float Depth;

  bool operator==(const Fragment &) const = default;
};

/// What a lane has of a batch, by number of vr_item.
inline constexpr unsigned ItemWords = sizeof(GradientSums) / 4;
using BatchItem = std::array<uint32_t, ItemWords>;

inline BatchItem itemOf(const GradientSums &G) {
  return std::bit_cast<BatchItem>(G);
}
inline BatchItem itemOf(const Fragment &F) {
  return {F.Primitive, F.Pixel, std::bit_cast<uint32_t>(F.Depth)};
}

/// What a command hands over together: entries VR_GRAD_LANES Number on of a
/// backward command's list, or as many fragments.
struct Batch {
  uint32_t Number = 0;
  uint32_t Count = 0; ///< 1 to VR_GRAD_LANES; 0: the command has ended
  std::array<BatchItem, VR_GRAD_LANES> Items{};
};

} // namespace vorion::raster
