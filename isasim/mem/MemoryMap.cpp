#include "vorion/isasim/MemoryMap.h"

#include "core/IsaTables.h"

#include <algorithm>

namespace vorion::isasim {

std::array<AddressRange, 2> globalRanges(const Config &C) {
  constexpr uint64_t MaxLow = VX_IMAGE_BASE - VX_GLOBAL_BASE;
  constexpr uint64_t MaxHigh = VX_STACK_TOP - VX_HIGH_BASE;
  const uint64_t Bytes =
      C.GlobalBytes ? C.GlobalBytes
                    : MaxLow + MaxHigh - std::min(MaxHigh, stackBytes(C));
  const uint64_t Low = std::min(Bytes, MaxLow);
  return {{{VX_GLOBAL_BASE, Low}, {VX_HIGH_BASE, Bytes - Low}}};
}

uint64_t globalBytes(const Config &C) {
  const auto [Low, High] = globalRanges(C);
  return Low.Bytes + High.Bytes;
}

uint64_t stackBytes(const Config &C) {
  return uint64_t{C.Clusters} * C.SocketsPerCluster * C.CoresPerSocket *
         C.WarpsPerCore * C.LanesPerWarp * C.StackBytes;
}

} // namespace vorion::isasim
