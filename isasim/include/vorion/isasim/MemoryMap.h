/// Where a machine's global memory lies (docs/abi.md, "Memory map").
#pragma once

#include "vorion/isasim/Config.h"

#include <array>
#include <cstdint>
#include <span>

namespace vorion::isasim {

/// Addresses from one on.
struct AddressRange {
  uint32_t Base = 0;
  uint64_t Bytes = 0;
};

/// In front of the image, and what does not fit there behind it. The second
/// part may be empty.
std::array<AddressRange, 2> globalRanges(const Config &C);

/// Both parts together.
uint64_t globalBytes(const Config &C);

/// The stack of each lane where a program needs \p Needed bytes of it: the
/// machine's, or the smallest larger power of two with as much room behind what
/// the start-up code leaves unused. 0 if it were larger than VX_MAX_STACK.
uint32_t stackFor(uint64_t Needed, const Config &C);

/// Of all lanes together.
uint64_t stackBytes(const Config &C);

/// The same of a launch of \p NumGroups groups on \p Warps warps of each core,
/// whose lanes have \p StackBytes each: stacks that are larger than the
/// machine's are there only for warps that have groups.
uint64_t stackBytes(const Config &C, uint32_t StackBytes, uint32_t Warps,
                    std::span<const uint32_t, 3> NumGroups);

} // namespace vorion::isasim
