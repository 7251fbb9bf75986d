#include "timing/TraceWriter.h"

#include "vorion/isasim/Timing.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace vorion::isasim {

namespace {

/// Words of the longest record.
constexpr size_t LongestRecord = 2 + MaxLanes;
constexpr size_t FirstRuns = 4096, FirstWords = 4096;
constexpr uint32_t LineMask = ~(TimingLineBytes - 1);

TraceBuffer &bufferOf(WarpState *S) {
  return *static_cast<TraceBuffer *>(S->Trace);
}

uint32_t put(AccessWord A) { return std::bit_cast<uint32_t>(A); }

/// Appends \p Line to Lines[0 .. Count) if it is not there yet.
void addDistinct(uint32_t *Lines, unsigned &Count, uint32_t Line) {
  for (unsigned N = Count; N != 0; --N)
    if (Lines[N - 1] == Line)
      return;
  Lines[Count++] = Line;
}

/// Where the line of a guest address lies in memory.
uint32_t lineOf(const WarpState *S, uint32_t Address) {
  const MemoryView &M = *S->Mem;
  if (S->Trace->InterleavedStacks && M.Stack.holds(Address, 1))
    Address = M.Stack.Lo + M.stackOffset(Address);
  return Address & LineMask;
}

/// The most distinct words that one bank has to give to the active lanes.
unsigned bankConflicts(const WarpState *S, const uint32_t *Addresses) {
  const uint32_t Banks = S->Trace->LocalBanks;
  uint32_t Words[MaxLanes];
  unsigned Distinct = 0;
  for (uint32_t Left = S->Mask; Left; Left &= Left - 1)
    addDistinct(Words, Distinct, Addresses[std::countr_zero(Left)] / 4);
  unsigned Most = 1;
  for (unsigned N = 0; N != Distinct; ++N) {
    unsigned Same = 1;
    for (unsigned K = 0; K != N; ++K)
      Same += Words[K] % Banks == Words[N] % Banks;
    Most = std::max(Most, Same);
  }
  return Most;
}

/// The most active lanes that name the same word.
unsigned sameWord(const WarpState *S, const uint32_t *Addresses) {
  unsigned Most = 1;
  for (uint32_t Left = S->Mask; Left; Left &= Left - 1) {
    const uint32_t Address = Addresses[std::countr_zero(Left)];
    unsigned Same = 0;
    for (uint32_t Others = Left; Others; Others &= Others - 1)
      Same += Addresses[std::countr_zero(Others)] == Address;
    Most = std::max(Most, Same);
  }
  return Most;
}

/// Whether every lane names the word behind its neighbour's.
bool isAscending(const uint32_t *Addresses) {
  for (unsigned L = 1; L != MaxLanes; ++L)
    if (Addresses[L] != Addresses[0] + 4 * L)
      return false;
  return true;
}

} // namespace

TraceBuffer::TraceBuffer() { place(FirstRuns, FirstWords); }

void TraceBuffer::place(size_t NumRuns, size_t NumWords) {
  const auto RunsWritten = static_cast<size_t>(RunAt ? RunAt - Runs.data() : 0);
  const auto WordsWritten =
      static_cast<size_t>(WordAt ? WordAt - Words.data() : 0);
  Runs.resize(NumRuns);
  Words.resize(NumWords);
  RunAt = Runs.data() + RunsWritten;
  RunEnd = Runs.data() + NumRuns;
  WordAt = Words.data() + WordsWritten;
  WordEnd = Words.data() + NumWords;
}

void TraceBuffer::grow() {
  place(RunEnd - RunAt < 2 ? 2 * Runs.size() : Runs.size(),
        static_cast<size_t>(WordEnd - WordAt) < LongestRecord ? 2 * Words.size()
                                                              : Words.size());
}

void TraceBuffer::clear() {
  RunAt = Runs.data();
  WordAt = Words.data();
  RunsRead = WordsRead = 0;
}

void TraceBuffer::compact() {
  const auto MoveDown = [](auto &All, auto *&At, size_t &Read) {
    const auto Left = static_cast<size_t>(At - All.data()) - Read;
    // Rarely enough to cost nothing for each record.
    if (Read < Left || Read == 0)
      return;
    std::memmove(All.data(), All.data() + Read, Left * sizeof(All[0]));
    At = All.data() + Left;
    Read = 0;
  };
  MoveDown(Runs, RunAt, RunsRead);
  MoveDown(Words, WordAt, WordsRead);
}

void traceRun(WarpState *S, const Insn *Start, const Insn *End) {
  constexpr ptrdiff_t Longest = UINT16_MAX;
  while (Start != End) {
    const ptrdiff_t Count = std::min(End - Start, Longest);
    if (S->Trace->RunEnd - S->Trace->RunAt < 1)
      bufferOf(S).grow();
    *S->Trace->RunAt++ = {static_cast<uint32_t>(Start - S->Code),
                          static_cast<uint16_t>(Count),
                          static_cast<uint16_t>(S->Mask)};
    Start += Count;
  }
}

void traceAccess(WarpState *S, const uint32_t *Addresses, unsigned Bytes,
                 bool IsStore, bool IsAtomic) {
  CoreTrace &T = *S->Trace;
  if (static_cast<size_t>(T.WordEnd - T.WordAt) < LongestRecord)
    bufferOf(S).grow();
  const uint32_t First = Addresses[std::countr_zero(S->Mask)];
  if (S->Mem->Local.holds(First, Bytes)) {
    *T.WordAt++ = put({.Lines = 0,
                       .Where = static_cast<uint32_t>(Space::Local),
                       .Whole = 0,
                       .Conflicts = bankConflicts(S, Addresses) +
                                    (IsAtomic ? sameWord(S, Addresses) - 1 : 0),
                       .Unused = 0});
    return;
  }
  uint32_t *Lines = T.WordAt + 1;
  unsigned Count = 0;
  // Neighbouring lanes mostly share a line.
  uint32_t Last = ~0U;
  for (uint32_t Left = S->Mask; Left; Left &= Left - 1) {
    const uint32_t Line = lineOf(S, Addresses[std::countr_zero(Left)]);
    if (Line == Last)
      continue;
    Last = Line;
    addDistinct(Lines, Count, Line);
  }
  static_assert(MaxLanes * 4 == TimingLineBytes);
  const bool Whole =
      IsStore && S->Full && Bytes == 4 && Count == 1 && isAscending(Addresses);
  *T.WordAt =
      put({.Lines = Count,
           .Where = static_cast<uint32_t>(Space::Memory),
           .Whole = Whole,
           .Conflicts = std::min(IsAtomic ? sameWord(S, Addresses) : 1U, 31U),
           .Unused = 0});
  T.WordAt += 1 + Count;
}

void traceWords(WarpState *S, std::span<const uint32_t> Words) {
  CoreTrace &T = *S->Trace;
  if (static_cast<size_t>(T.WordEnd - T.WordAt) < LongestRecord)
    bufferOf(S).grow();
  T.WordAt = std::copy(Words.begin(), Words.end(), T.WordAt);
}

void traceParked(WarpState *S, const Insn *I, Event E,
                 std::span<const uint32_t> Words) {
  CoreTrace &T = *S->Trace;
  if (T.RunEnd - T.RunAt < 1)
    bufferOf(S).grow();
  *T.RunAt++ = {static_cast<uint32_t>(I - S->Code), 0,
                static_cast<uint16_t>(S->Mask)};
  const uint32_t Kind = static_cast<uint32_t>(E);
  traceWords(S, {&Kind, 1});
  traceWords(S, Words);
}

} // namespace vorion::isasim
