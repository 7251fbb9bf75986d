#include "timing/trace/LinesOfAccess.h"

#include "vorion/isasim/Timing.h"

#include <bit>
#include <cstring>

namespace vorion::isasim {

namespace {

constexpr uint32_t LineMask = ~(TimingLineBytes - 1);

/// Appends \p Line to Lines[0 .. Count) if it is not there yet.
void addDistinct(uint32_t *Lines, unsigned &Count, uint32_t Line) {
  for (unsigned N = Count; N != 0; --N)
    if (Lines[N - 1] == Line)
      return;
  Lines[Count++] = Line;
}

/// The active lanes of a warp and what decides where their words lie.
struct Lanes {
  const WarpState &S;
  const bool InterleavedStacks;

  /// Whether a guest address lies where the stacks are interleaved.
  bool isInterleaved(uint32_t Address) const {
    return InterleavedStacks && S.Mem->Stack.holds(Address, 1);
  }
  uint32_t lineOf(uint32_t Address) const;
  bool isOneLine(const uint32_t *Addresses, uint32_t First) const;
};

/// Where the line of a guest address lies in memory.
uint32_t Lanes::lineOf(uint32_t Address) const {
  const MemoryView &M = *S.Mem;
  if (isInterleaved(Address))
    Address = M.Stack.Lo + M.stackOffset(Address);
  return Address & LineMask;
}

/// Whether all active lanes share a line, which most accesses do; \p First is
/// the address of one of them. It may say no where they do.
bool Lanes::isOneLine(const uint32_t *Addresses, uint32_t First) const {
  LaneWords Where;
  std::memcpy(&Where, Addresses, sizeof(Where));
  if (isInterleaved(First)) {
    const MemoryView &M = *S.Mem;
    const LaneWords Outside =
        std::bit_cast<LaneWords>(Where - M.Stack.Lo >= M.Stack.Bytes);
    if (bitsOfAny(S, Outside))
      return false;
    Where = M.stackOffset(Where);
    First = M.stackOffset(First);
  }
  return !(bitsOfAny(S, Where ^ First) & LineMask);
}

} // namespace

unsigned linesOfAccess(const WarpState &S, const uint32_t *Addresses,
                       bool InterleavedStacks, uint32_t *Lines) {
  const Lanes Active{S, InterleavedStacks};
  const uint32_t First = Addresses[std::countr_zero(S.Mask)];
  if (Active.isOneLine(Addresses, First)) {
    Lines[0] = Active.lineOf(First);
    return 1;
  }
  unsigned Count = 0;
  // Neighbouring lanes mostly share a line.
  uint32_t Last = ~Active.lineOf(First);
  for (uint32_t Left = S.Mask; Left; Left &= Left - 1) {
    const uint32_t Line = Active.lineOf(Addresses[std::countr_zero(Left)]);
    if (Line == Last)
      continue;
    Last = Line;
    addDistinct(Lines, Count, Line);
  }
  return Count;
}

} // namespace vorion::isasim
