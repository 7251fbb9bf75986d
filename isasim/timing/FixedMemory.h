/// Memory that answers every request after the same time, in place of the L2
/// and what lies behind it: as other machines are measured with that are to be
/// compared by their cores alone.
#pragma once

#include "timing/Cache.h"

#include <algorithm>

namespace vorion::isasim {

/// Takes a line a cycle, in the order of the calls.
class FixedMemory {
public:
  /// None if \p CyclesIn is 0.
  explicit FixedMemory(uint32_t CyclesIn) : Cycles(CyclesIn) {}

  bool exists() const { return Cycles != 0; }

  /// When a read's line is back with who asked, or a write has been taken.
  uint64_t access(const CacheRequest &R) {
    const uint64_t Taken = std::max(R.Now, FreeAt);
    FreeAt = Taken + 1 + R.Extra;
    if (R.Op == CacheOp::Write || R.Op == CacheOp::WriteWhole)
      return Taken;
    return Taken + R.Extra + Cycles + R.Back;
  }

private:
  const uint32_t Cycles;
  uint64_t FreeAt = 0;
};

} // namespace vorion::isasim
