/// What a Raster Agent hands to its rasterizer, and what comes back.
#pragma once

#include "raster/RasterTables.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vorion::raster {

/// The configuration bank at the write of vr_start, as written: checkCommand()
/// reads and judges it (Job.h).
struct Command : BankWords {
  std::vector<Gaussian> Pushed; ///< descriptors of mode "pushed", in order
  bool PushOverflowed = false;  ///< some did not fit the push buffer

  bool isBackward() const { return ModeBackward.get(Mode) != 0; }
};

class RasterAgent;

/// A hand-over: whose command goes on, and the address of its vx_tail.
struct HandOver {
  RasterAgent *Agent;
  uint32_t Record;
};

/// A pixel as it leaves the rasterizer; the background is not applied.
struct Pixel {
  float R = 0, G = 0, B = 0;
  float T = 0; ///< transmittance

  bool operator==(const Pixel &) const = default;
};
static_assert(sizeof(Pixel) == 16, "docs/abi.md: four floats a pixel");

/// What a Gaussian is handed over with: the words of vr_grad_tag to _syy.
struct GradientSums {
  uint32_t Tag = 0;
  /// dL/dr, dL/dg, dL/db; s, s dx, s dy, s dx dx, s dx dy, s dy dy.
  std::array<float, 9> Sums{};

  bool operator==(const GradientSums &) const = default;
};

/// Gaussians that a backward command hands over together: entries
/// VR_GRAD_LANES Number on of its list.
struct GradientBatch {
  uint32_t Number = 0;
  uint32_t Count = 0; ///< 1 to VR_GRAD_LANES; 0: the command has ended
  std::array<GradientSums, VR_GRAD_LANES> Gaussians{};
};

} // namespace vorion::raster
