/// The address ranges of a machine's global memory (docs/abi.md, "Memory map").
#pragma once

#include "vorion/isasim/Config.h"

#include <array>
#include <cstdint>
#include <span>

namespace vorion::isasim {

/// A range of addresses.
struct AddressRange {
  uint32_t Base = 0;
  uint64_t Bytes = 0;
};

/// First byte of global memory, the end of the I/O window: VX_GLOBAL_BASE, or
/// the first page behind the raster CSRs of the last core.
uint32_t globalBase(const Config &C);

/// The range below the image, and the rest above it, which may be empty.
std::array<AddressRange, 2> globalRanges(const Config &C);

/// Total size of both ranges.
uint64_t globalBytes(const Config &C);

/// Stack size per lane for a program that needs \p Needed bytes: the machine's
/// default, or the smallest sufficient power of two including the part that the
/// start-up code leaves unused. 0 if larger than VX_MAX_STACK.
uint32_t stackFor(uint64_t Needed, const Config &C);

/// Total stack size of all lanes.
uint64_t stackBytes(const Config &C);

/// Total stack size of a launch of \p NumGroups groups on \p Warps warps per
/// core, with \p StackBytes per lane: only warps with groups have stacks larger
/// than the machine's default.
uint64_t stackBytes(const Config &C, uint32_t StackBytes, uint32_t Warps,
                    std::span<const uint32_t, 3> NumGroups);

} // namespace vorion::isasim
