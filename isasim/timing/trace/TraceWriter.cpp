#include "timing/trace/TraceWriter.h"

#include "timing/trace/LinesOfAccess.h"
#include "vorion/isasim/Timing.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace vorion::isasim {

namespace {

/// Words of the longest record.
constexpr size_t LongestRecord = 2 + MaxLanes;
constexpr size_t FirstRuns = 4096, FirstWords = 4096;
/// See timing.core.local_banks.
constexpr uint32_t MostLocalBanks = 64;

TraceBuffer &bufferOf(WarpState *S) {
  return *static_cast<TraceBuffer *>(S->Trace);
}

uint32_t put(AccessWord A) { return std::bit_cast<uint32_t>(A); }

/// Whether the active lanes name one word, or each lane the word behind its
/// neighbour's, as most accesses do.
bool isOneWordOrRow(const WarpState &S, const uint32_t *Addresses) {
  LaneWords Words;
  std::memcpy(&Words, Addresses, sizeof(Words));
  Words /= 4;
  LaneWords Lane;
  for (unsigned L = 0; L != MaxLanes; ++L)
    Lane[L] = L;
  const auto First = static_cast<unsigned>(std::countr_zero(S.Mask));
  const uint32_t Word = Addresses[First] / 4;
  return !bitsOfAny(S, Words ^ Word) ||
         !bitsOfAny(S, (Words - Lane) ^ (Word - First));
}

/// The most distinct words that one bank has to give to the active lanes.
unsigned bankConflicts(const WarpState *S, const uint32_t *Addresses) {
  // Of each bank the words that it has to give so far, as a list of lanes from
  // the last one; a lane's number stands for one more, 0 for none.
  uint8_t Last[MostLocalBanks] = {}, Before[MaxLanes],
          Given[MostLocalBanks] = {};
  const uint32_t Banks = S->Trace->LocalBanks;
  if (Banks >= MaxLanes && isOneWordOrRow(*S, Addresses))
    return 1;
  const bool IsPowerOfTwo = std::has_single_bit(Banks);
  unsigned Most = 1;
  for (uint32_t Left = S->Mask; Left; Left &= Left - 1) {
    const auto Lane = static_cast<unsigned>(std::countr_zero(Left));
    const uint32_t Word = Addresses[Lane] / 4;
    const uint32_t Bank = IsPowerOfTwo ? Word & (Banks - 1) : Word % Banks;
    unsigned Other = Last[Bank];
    while (Other && Addresses[Other - 1] / 4 != Word)
      Other = Before[Other - 1];
    if (Other)
      continue;
    Before[Lane] = std::exchange(Last[Bank], static_cast<uint8_t>(Lane + 1));
    Most = std::max<unsigned>(Most, ++Given[Bank]);
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

TraceBuffer::TraceBuffer() : WrittenRuns(FirstRuns), WrittenWords(FirstWords) {
  Runs.All.resize(FirstRuns);
  Words.All.resize(FirstWords);
  place(0, 0);
}

/// Writing goes on behind what is in use.
void TraceBuffer::place(size_t RunsInUse, size_t WordsInUse) {
  RunAt = WrittenRuns.data() + RunsInUse;
  RunEnd = WrittenRuns.data() + WrittenRuns.size();
  WordAt = WrittenWords.data() + WordsInUse;
  WordEnd = WrittenWords.data() + WrittenWords.size();
}

void TraceBuffer::grow() {
  const size_t RunsInUse = runsWritten(), WordsInUse = wordsWritten();
  if (WrittenRuns.size() - RunsInUse < 2)
    WrittenRuns.resize(2 * WrittenRuns.size());
  if (WrittenWords.size() - WordsInUse < LongestRecord)
    WrittenWords.resize(2 * WrittenWords.size());
  place(RunsInUse, WordsInUse);
}

void TraceBuffer::clear() {
  place(0, 0);
  Runs.Read = Runs.Count = 0;
  Words.Read = Words.Count = 0;
}

template <typename Record>
void TraceBuffer::Published<Record>::take(std::vector<Record> &Written,
                                          size_t More) {
  if (empty()) {
    std::swap(All, Written);
    Read = 0;
    Count = More;
    return;
  }
  // Rarely enough to cost nothing for each record.
  if (Read >= size()) {
    std::copy(All.data() + Read, All.data() + Count, All.data());
    Count -= std::exchange(Read, 0);
  }
  if (All.size() < Count + More)
    All.resize(std::max(2 * All.size(), Count + More));
  std::copy_n(Written.data(), More, All.data() + Count);
  Count += More;
}

void TraceBuffer::publish() {
  Runs.take(WrittenRuns, runsWritten());
  Words.take(WrittenWords, wordsWritten());
  place(0, 0);
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
  const unsigned Count =
      linesOfAccess(*S, Addresses, T.InterleavedStacks, Lines);
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
