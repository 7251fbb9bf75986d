/// A core's data cache as it changes time: tags alone, since function never
/// depends on time.
#pragma once

#include "vorion/isasim/Timing.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace vorion::isasim {

/// Loads fill it, stores write through and allocate nothing. Not coherent: it
/// forgets its lines when a run begins.
class DataCache {
public:
  /// None if \p Kib is 0.
  DataCache(uint32_t Kib, uint32_t WaysIn)
      : Ways(WaysIn), Sets(Kib * 1024 / TimingLineBytes / WaysIn),
        Lines(size_t{Sets} * Ways) {}

  bool exists() const { return Sets != 0; }
  void clear() { std::fill(Lines.begin(), Lines.end(), Line()); }

  struct Line {
    uint32_t Tag = 0; ///< line number plus 1, 0 for none
    uint64_t Used = 0;
    uint64_t ReadyAt = 0; ///< when it was or will be there
    /// Writes to memory that it has seen (LineWriters::count()).
    uint64_t Writes = 0;
  };
  /// The line of \p Address, or nullptr.
  const Line *find(uint32_t Address) {
    const uint32_t Number = Address / TimingLineBytes;
    Line *Set = setOf(Number);
    for (uint32_t W = 0; W != Ways; ++W)
      if (Set[W].Tag == Number + 1) {
        Set[W].Used = ++Uses;
        return &Set[W];
      }
    return nullptr;
  }

  /// The line of \p Address comes at \p ReadyAt with the first \p Writes
  /// writes in it, in the place of the least recently used one.
  void fill(uint32_t Address, uint64_t ReadyAt, uint64_t Writes) {
    const uint32_t Number = Address / TimingLineBytes;
    Line *Set = setOf(Number);
    *std::min_element(Set, Set + Ways, [](const Line &A, const Line &B) {
      return A.Used < B.Used;
    }) = {Number + 1, ++Uses, ReadyAt, Writes};
  }

private:
  Line *setOf(uint32_t Number) { return &Lines[size_t{Number % Sets} * Ways]; }

  uint32_t Ways, Sets;
  std::vector<Line> Lines;
  uint64_t Uses = 0;
};

} // namespace vorion::isasim
