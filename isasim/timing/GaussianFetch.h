/// What fetches lists and the records that they name, for rasterizers and pixel
/// units.
#pragma once

#include "raster/RasterTables.h"
#include "timing/MemorySystem.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace vorion::isasim {

/// The line of memory that holds an address.
constexpr uint32_t lineOf(uint32_t Address) {
  return Address & ~(TimingLineBytes - 1);
}

/// Asks for a line a cycle, and for a Gaussian when the buffer has an entry for
/// it. Gaussians are numbered in the order of their fetches.
class GaussianFetch {
public:
  GaussianFetch(unsigned ClusterIn, unsigned Entries)
      : Cluster(ClusterIn), FreeAt(Entries) {}

  /// A command begins at \p Now: the buffer is empty.
  void begin(uint64_t Now) {
    Next = Now;
    std::fill(FreeAt.begin(), FreeAt.end(), Now);
    beginList();
  }
  /// The list is gone through from its first entry.
  void beginList() { ListLine = NoLine; }

  /// The next cycle in which something can be asked for.
  uint64_t now() const { return Next; }
  void waitUntil(uint64_t Then) { Next = std::max(Next, Then); }
  /// Does not ask for anything in this cycle.
  void skip() { ++Next; }

  unsigned entries() const { return static_cast<unsigned>(FreeAt.size()); }
  /// When Gaussian \p Number can be asked for.
  uint64_t startOf(size_t Number) const {
    return std::max(Next, FreeAt[Number % FreeAt.size()]);
  }
  /// It keeps its entry until \p Then.
  void hold(size_t Number, uint64_t Then) {
    FreeAt[Number % FreeAt.size()] = Then;
  }

  /// Asks for a line; returns when it has come or been taken.
  uint64_t line(MemorySystem &Memory, uint32_t Address,
                CacheOp Op = CacheOp::Read, bool Keep = false) {
    return Memory.access(
        Cluster, {.Now = Next++, .Address = Address, .Op = Op, .Keep = Keep});
  }
  /// Likewise the lines of a range, which is not empty; returns when all have
  /// come.
  uint64_t read(MemorySystem &Memory, uint32_t Address, uint32_t Bytes,
                bool Keep = false) {
    uint64_t Ready = 0;
    const uint32_t Last = lineOf(Address + Bytes - 1);
    for (uint32_t Line = lineOf(Address);; Line += TimingLineBytes) {
      Ready = std::max(Ready, line(Memory, Line, CacheOp::Read, Keep));
      if (Line == Last)
        return Ready;
    }
  }

  /// Whether the list's entry at \p Address is there now; if not, now() becomes
  /// the time at which it is. When the first entry of a line is used, the line
  /// \p Ahead bytes on is asked for, if that is not 0.
  bool hasEntry(MemorySystem &Memory, uint32_t Address, int Ahead = 0) {
    if (const uint32_t Line = lineOf(Address); Line != ListLine) {
      const bool IsThere = Ahead && ListLine != NoLine;
      ListReady = IsThere ? AheadReady : line(Memory, Line);
      if (Ahead)
        AheadReady = line(Memory, Line + static_cast<uint32_t>(Ahead));
      ListLine = Line;
    }
    if (ListReady <= Next)
      return true;
    Next = ListReady;
    return false;
  }
  /// The record at \p Address; \p Keep: see CacheRequest.
  uint64_t readRecord(MemorySystem &Memory, uint32_t Address,
                      bool Keep = false) {
    return read(Memory, Address, sizeof(raster::Gaussian), Keep);
  }

private:
  /// Where no line begins.
  static constexpr uint32_t NoLine = 1;

  unsigned Cluster;
  uint64_t Next = 0;
  std::vector<uint64_t> FreeAt; ///< entries of the buffer
  uint32_t ListLine = NoLine;   ///< of the list, that was asked for last
  uint64_t ListReady = 0, AheadReady = 0;
};

} // namespace vorion::isasim
