/// What fetches lists and the records that they name, for rasterizers and pixel
/// units.
#pragma once

#include "raster/RasterTables.h"
#include "timing/memory/LineWaits.h"

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
  /// Sets of lines beside the Gaussians'.
  enum LineSet : unsigned { EvenList, OddList, Others, EvenOthers, OddOthers };

  GaussianFetch(MemoryPort Port, unsigned Entries)
      : Waits(Port, FirstEntry + Entries), FreeAt(Entries) {}

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

  unsigned entries() const { return static_cast<unsigned>(FreeAt.size()); }
  /// When Gaussian \p Number can be asked for; Turn::Never while its entry is
  /// held by one of which nobody knows when it is done.
  uint64_t startOf(size_t Number) const {
    return std::max(Next, FreeAt[Number % FreeAt.size()]);
  }
  /// It keeps its entry until \p Then.
  void hold(size_t Number, uint64_t Then) {
    FreeAt[Number % FreeAt.size()] = Then;
  }

  /// \name Sets of lines
  /// @{
  void beginSet(unsigned Set) { Waits.begin(Set, Next); }
  void line(MemorySystem &Memory, unsigned Set, uint32_t Address,
            CacheOp Op = CacheOp::Read, bool Keep = false) {
    CacheRequest R{.Now = Next++, .Address = Address, .Op = Op, .Keep = Keep};
    Waits.ask(Memory, Set, R);
  }
  /// Reads the lines of a range, which is not empty.
  void read(MemorySystem &Memory, unsigned Set, uint32_t Address,
            uint32_t Bytes, bool Keep = false) {
    const uint32_t Last = lineOf(Address + Bytes - 1);
    for (uint32_t Line = lineOf(Address);; Line += TimingLineBytes) {
      line(Memory, Set, Line, CacheOp::Read, Keep);
      if (Line == Last)
        return;
    }
  }
  /// When all lines of the set have come or been taken; Turn::Never if that is
  /// not known yet.
  uint64_t readyAt(unsigned Set) const { return Waits.readyAt(Set); }
  /// Likewise, with how the last one came or was taken.
  Arrival arrivalOf(unsigned Set) const { return Waits.arrivalOf(Set); }
  /// An answer of memory. Returns whether a set is known by it.
  bool answer(const Answer &A) { return Waits.answer(A).has_value(); }
  /// @}

  /// When the list's entry at \p Address is there, not before now(). Asks for
  /// its line, if need be; when the first entry of a line is used, the line
  /// \p Ahead bytes on is asked for, if that is not 0.
  uint64_t entryAt(MemorySystem &Memory, uint32_t Address, int Ahead = 0) {
    const uint32_t Line = lineOf(Address);
    if (Line != ListLine) {
      if (!Ahead || ListLine == NoLine)
        askList(Memory, Line);
      if (Ahead)
        askList(Memory, Line + static_cast<uint32_t>(Ahead));
      ListLine = Line;
    }
    return std::max(Next, Waits.readyAt(listSet(Line)));
  }
  /// How the line of the last entryAt() came.
  Arrival arrivalOfEntry() const { return arrivalOf(listSet(ListLine)); }
  /// Asks for the record of \p Bytes at \p Address; \p Keep: see CacheRequest.
  /// The Gaussian holds its entry until hold() says otherwise.
  void readRecord(MemorySystem &Memory, size_t Number, uint32_t Address,
                  uint32_t Bytes, bool Keep = false) {
    beginGaussian(Number);
    read(Memory, setOf(Number), Address, Bytes, Keep);
  }
  /// Likewise for a Gaussian without a record in memory, which takes a cycle.
  void skipRecord(size_t Number) {
    beginGaussian(Number);
    ++Next;
  }
  /// When the Gaussian's record is there; Turn::Never if that is not known yet.
  Arrival arrivalOfRecord(size_t Number) const {
    return arrivalOf(setOf(Number));
  }

private:
  /// Where no line begins.
  static constexpr uint32_t NoLine = 1;
  static constexpr unsigned FirstEntry = OddOthers + 1;

  /// Neighbouring lines have different sets.
  static unsigned listSet(uint32_t Line) {
    return Line / TimingLineBytes % 2 ? OddList : EvenList;
  }
  void askList(MemorySystem &Memory, uint32_t Line) {
    beginSet(listSet(Line));
    line(Memory, listSet(Line), Line);
  }
  unsigned setOf(size_t Number) const {
    return FirstEntry + static_cast<unsigned>(Number % FreeAt.size());
  }
  void beginGaussian(size_t Number) {
    hold(Number, Turn::Never);
    beginSet(setOf(Number));
  }

  LineWaits Waits;
  uint64_t Next = 0;
  std::vector<uint64_t> FreeAt; ///< entries of the buffer
  uint32_t ListLine = NoLine;   ///< of the list, that was used last
};

} // namespace vorion::isasim
