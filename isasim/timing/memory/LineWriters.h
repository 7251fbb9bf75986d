/// Who wrote each line of memory last: what caches that are not coherent need
/// to know to count what they miss.
#pragma once

#include "timing/memory/Cache.h"

#include <cstdint>
#include <unordered_map>

namespace vorion::isasim {

/// Writes are numbered in the order in which they leave for the L2.
class LineWriters {
public:
  /// \p Unit writes a line. Of an atomic it is Ticket::Nobody: nobody's data
  /// cache has what was done at the L2.
  void written(uint32_t Address, uint32_t Unit) {
    Writes &W = Lines[Address / TimingLineBytes];
    if (W.Unit != Unit) {
      W.LastOfOthers = W.Last;
      W.Unit = Unit;
    }
    W.Last = ++Count;
  }
  /// How many writes there have been.
  uint64_t count() const { return Count; }
  /// Whether anybody but \p Unit wrote the line behind write number \p Since.
  bool isWritten(uint32_t Address, uint64_t Since, uint32_t Unit) const {
    const auto Found = Lines.find(Address / TimingLineBytes);
    if (Found == Lines.end())
      return false;
    const Writes &W = Found->second;
    return (W.Unit == Unit ? W.LastOfOthers : W.Last) > Since;
  }
  void clear() {
    Lines.clear();
    Count = 0;
  }

private:
  struct Writes {
    uint32_t Unit = Ticket::Nobody; ///< the last to write
    uint64_t Last = 0;              ///< its last write
    uint64_t LastOfOthers = 0;      ///< of all but it
  };
  std::unordered_map<uint32_t, Writes> Lines;
  uint64_t Count = 0;
};

} // namespace vorion::isasim
