#include "vorion/isasim/MemoryMap.h"

#include "core/IsaTables.h"

#include <algorithm>
#include <bit>

namespace vorion::isasim {

namespace {

constexpr uint64_t MaxHigh = VX_STACK_TOP - VX_HIGH_BASE;

/// What is left of a stack where start.S leaves the most unused.
constexpr uint64_t roomIn(uint32_t StackBytes) {
  return StackBytes - uint64_t{StackBytes} / 128 * 15;
}

} // namespace

uint32_t globalBase(const Config &C) {
  constexpr uint32_t Page = 4096;
  const uint32_t End = VX_IO_RASTER + C.cores() * VX_IO_RASTER_STRIDE;
  return std::max<uint32_t>(VX_GLOBAL_BASE, (End + Page - 1) / Page * Page);
}

std::array<AddressRange, 2> globalRanges(const Config &C) {
  const uint32_t Base = globalBase(C);
  const uint64_t MaxLow = VX_IMAGE_BASE - Base;
  const uint64_t Bytes =
      C.GlobalBytes ? C.GlobalBytes
                    : MaxLow + MaxHigh - std::min(MaxHigh, stackBytes(C));
  const uint64_t Low = std::min(Bytes, MaxLow);
  return {{{Base, Low}, {VX_HIGH_BASE, Bytes - Low}}};
}

uint64_t globalBytes(const Config &C) {
  const auto [Low, High] = globalRanges(C);
  return Low.Bytes + High.Bytes;
}

uint32_t stackFor(uint64_t Needed, const Config &C) {
  static_assert(roomIn(VX_MAX_STACK) == VX_MAX_STACK_ROOM);
  if (Needed > VX_MAX_STACK_ROOM)
    return 0;
  uint32_t Bytes = C.StackBytes;
  while (roomIn(Bytes) < Needed)
    Bytes *= 2;
  return Bytes;
}

uint64_t stackBytes(const Config &C, uint32_t StackBytes, uint32_t Warps,
                    std::span<const uint32_t, 3> NumGroups) {
  if (StackBytes == C.StackBytes)
    return stackBytes(C);
  uint64_t Cores = 1; // that have groups
  for (const uint32_t N : NumGroups)
    Cores = std::min<uint64_t>(Cores * std::max(N, 1U), C.cores());
  return Cores * Warps * C.LanesPerWarp * StackBytes;
}

uint64_t stackBytes(const Config &C) {
  return uint64_t{C.Clusters} * C.SocketsPerCluster * C.CoresPerSocket *
         C.WarpsPerCore * C.LanesPerWarp * C.StackBytes;
}

} // namespace vorion::isasim
