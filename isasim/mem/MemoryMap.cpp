#include "vorion/isasim/MemoryMap.h"

#include "core/IsaTables.h"

#include <algorithm>

namespace vorion::isasim {

std::array<AddressRange, 2> globalRanges(const Config &C) {
  constexpr uint64_t MaxLow = VX_IMAGE_BASE - VX_GLOBAL_BASE;
  const uint64_t Low = std::min(C.GlobalBytes, MaxLow);
  return {{{VX_GLOBAL_BASE, Low}, {VX_HIGH_BASE, C.GlobalBytes - Low}}};
}

} // namespace vorion::isasim
