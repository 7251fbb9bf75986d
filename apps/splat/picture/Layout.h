/// The structures of kernels/layout.h for the host.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vorion::splat {

using uint = uint32_t;
#include "kernels/layout.h"

static_assert(sizeof(splat_gaussian) == 48, "docs/abi.md: vx_gaussian");
static_assert(sizeof(splat_ray_gaussian) == 64, "docs/isa.md: vx_ray_gaussian");
static_assert(sizeof(splat_blend_options) == 48,
              "4-byte members without padding");
static_assert(sizeof(splat_density) == 24, "4-byte members without padding");
static_assert(sizeof(splat_lens) == 60, "4-byte members without padding");
static_assert(sizeof(splat_shutter) == 40, "4-byte members without padding");
static_assert(sizeof(splat_crop) == 92, "4-byte members without padding");
static_assert(sizeof(splat_windows) <= sizeof(splat_gaussian),
              "they lie in the place of a record");
static_assert(sizeof(splat_view) == 144, "4-byte members without padding");

/// Blocks of LINE_WORDS that so many Gaussians take.
constexpr uint32_t blocksOf(std::size_t Gaussians) {
  return static_cast<uint32_t>((Gaussians + LINE_WORDS - 1) / LINE_WORDS);
}

} // namespace vorion::splat
