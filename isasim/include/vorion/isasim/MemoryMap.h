/// Where a machine's global memory lies (docs/abi.md, "Memory map").
#pragma once

#include "vorion/isasim/Config.h"

#include <array>
#include <cstdint>

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

/// Of all lanes together.
uint64_t stackBytes(const Config &C);

} // namespace vorion::isasim
