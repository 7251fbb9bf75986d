/// What a unit has asked memory for and waits for.
#pragma once

#include "timing/common/Turn.h"
#include "timing/memory/MemorySystem.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

namespace vorion::isasim {

/// Where a unit reaches memory.
struct MemoryPort {
  unsigned Cluster = 0;
  uint32_t Unit = 0; ///< what it is called in answers
};

/// Sets of lines. A set is ready when its last line has come or been taken.
class LineWaits {
public:
  LineWaits(MemoryPort PortIn, unsigned Count)
      : Port(PortIn), Sets(std::bit_ceil(Count)) {
    for (uint32_t N = 0; N != Sets.size(); ++N)
      Sets[N].Tag = N;
  }

  /// Set \p N is empty from now on, and ready at \p Now: what is still to come
  /// for it is nobody's any more.
  void begin(unsigned N, uint64_t Now = 0) {
    Set &S = Sets[N];
    S = {S.Tag + static_cast<uint32_t>(Sets.size()), 0, Now};
  }
  /// Asks for a line of set \p N.
  void ask(MemorySystem &Memory, unsigned N, CacheRequest R) {
    Set &S = Sets[N];
    R.From = {Port.Unit, S.Tag};
    if (const auto At = Memory.access(Port.Cluster, R))
      S.Ready = std::max(S.Ready, *At);
    else
      ++S.Open;
  }
  /// A line of set \p N is there at \p Then, and nobody has to be asked.
  void add(unsigned N, uint64_t Then) {
    Sets[N].Ready = std::max(Sets[N].Ready, Then);
  }
  /// When set \p N is ready; Turn::Never if that is not known yet.
  uint64_t readyAt(unsigned N) const {
    return Sets[N].Open ? Turn::Never : Sets[N].Ready;
  }
  /// An answer of memory; returns the set that is known by it.
  std::optional<unsigned> answer(uint32_t Tag, uint64_t Then) {
    const auto N = static_cast<unsigned>(Tag & (Sets.size() - 1));
    Set &S = Sets[N];
    if (S.Tag != Tag)
      return std::nullopt;
    S.Ready = std::max(S.Ready, Then);
    if (--S.Open != 0)
      return std::nullopt;
    return N;
  }

private:
  struct Set {
    uint32_t Tag = 0; ///< the set's number, and how often it began
    uint32_t Open = 0;
    uint64_t Ready = 0;
  };
  MemoryPort Port;
  std::vector<Set> Sets;
};

} // namespace vorion::isasim
