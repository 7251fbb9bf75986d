/// A socket's instruction cache as it changes time: tags alone, since function
/// never depends on time.
#pragma once

#include "timing/memory/LineWaits.h"
#include "timing/memory/MemorySystem.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace vorion::isasim {

/// The cores of a socket share it. A launch resets it, so that it is empty when
/// a run begins. Lines are numbered from the program's first one.
class InstructionCache {
public:
  /// None if Params.IcacheKib is 0.
  InstructionCache(const SocketTiming &Params, MemoryPort ToMemory);

  bool exists() const { return Sets != 0; }
  /// A run begins of a program of \p CodeLines lines from \p CodeLow on.
  void begin(uint32_t CodeLow, uint32_t CodeLines);

  /// A core's warp that waits for a line.
  struct Waiter {
    unsigned Core, Warp;
  };
  /// When the line is or was there. Nothing if memory has to answer first:
  /// then answer() names who asked. Called in the order of time.
  std::optional<Arrival> fetch(MemorySystem &Memory, uint32_t Line,
                               uint64_t Now, Waiter Who);
  /// An answer of memory; returns the line and who waited for it.
  struct Arrived {
    uint32_t Line;
    std::vector<Waiter> Who;
  };
  Arrived answer(const Answer &A);

  /// Whether a line that is there stays until the run's end, because the
  /// program has no more lines in its set than there are ways.
  bool keeps(uint32_t Line) const;

  uint64_t misses() const { return Misses; }

private:
  struct Way {
    uint32_t Number = 0; ///< of the line, plus 1; 0 for none
    uint64_t Used = 0;
    Arrival Ready;
  };
  Way *setOf(uint32_t Line) { return &Ways[size_t{Line % Sets} * WaysOfSet]; }
  void fill(uint32_t Line, const Arrival &Then);

  const MemoryPort Port;
  const uint32_t WaysOfSet, Sets;
  std::vector<Way> Ways;
  std::vector<Arrived> Asked; ///< by ticket; nobody waits once it is there
  uint32_t CodeLow = 0, CodeLines = 0;
  uint64_t Uses = 0, Misses = 0;
};

} // namespace vorion::isasim
