#include "timing/Dram.h"

#include <algorithm>

namespace vorion::isasim {

bool Dram::Bus::isFree(uint64_t Slot) {
  return Taken[Slot % Slots] != Slot + 1;
}

uint64_t Dram::Bus::take(uint64_t First, unsigned Length) {
  // What lies a whole ring back can no longer be told from what is free.
  First = std::max(First, Oldest);
  uint64_t Run = 0;
  uint64_t Slot = First;
  for (; Run != Length; ++Slot)
    Run = isFree(Slot) ? Run + 1 : 0;
  for (uint64_t S = Slot - Length; S != Slot; ++S)
    Taken[S % Slots] = S + 1;
  if (Slot > Oldest + Slots)
    Oldest = Slot - Slots;
  return Slot - Length;
}

Dram::Dram(const DramTiming &Params)
    : P(Params),
      BurstsPerLine((TimingLineBytes + P.BurstBytes - 1) / P.BurstBytes),
      Channels(P.Channels) {
  for (Channel &C : Channels)
    C.Banks.resize(P.Banks);
}

/// All banks of a channel are refreshed every tREFI and are closed for tRFC.
uint64_t Dram::afterRefresh(Channel &C, uint64_t Now) {
  if (P.TrefiPs == 0)
    return Now;
  const uint64_t Epoch = Now / P.TrefiPs;
  if (Epoch != C.RefreshEpoch && Epoch != 0) {
    Counted.Refreshes += Epoch - std::min(Epoch, C.RefreshEpoch);
    C.RefreshEpoch = Epoch;
    const uint64_t Ready = Epoch * P.TrefiPs + P.TrfcPs;
    for (Bank &B : C.Banks) {
      B.IsOpen = false;
      B.ActivateAt = std::max(B.ActivateAt, Ready);
    }
  }
  const uint64_t Into = Now % P.TrefiPs;
  return Epoch != 0 && Into < P.TrfcPs ? Now - Into + P.TrfcPs : Now;
}

uint64_t Dram::activate(Channel &C, uint64_t Wanted) {
  uint64_t At = Wanted;
  if (C.AnyActivation)
    At = std::max(At, C.LastActivation + P.TrrdPs);
  if (const uint64_t Fourth = C.Activations[C.NextActivation])
    At = std::max(At, Fourth + P.TfawPs);
  C.Activations[C.NextActivation] = At;
  C.NextActivation = (C.NextActivation + 1) % 4;
  C.LastActivation = At;
  C.AnyActivation = true;
  return At;
}

uint64_t Dram::access(uint64_t Now, uint32_t Address, bool IsWrite) {
  // Lines go round the channels, so that a stream uses all of them; within a
  // channel a row's lines are neighbours, and rows go round the banks.
  const uint32_t Line = Address / TimingLineBytes;
  Channel &C = Channels[Line % P.Channels];
  const uint32_t LineOfChannel = Line / P.Channels;
  const uint32_t RowOfChannel =
      LineOfChannel / std::max(1U, P.RowBytes / TimingLineBytes);
  // Arrays a power of two apart would share a bank: rows are spread by their
  // higher bits too (Zhang, Zhu and Zhang 2000, "A permutation-based page
  // interleaving scheme").
  uint32_t Spread = 0;
  for (uint32_t Left = RowOfChannel; Left && P.Banks > 1; Left /= P.Banks)
    Spread += Left;
  Bank &B = C.Banks[Spread % P.Banks];
  const uint32_t Row = RowOfChannel;

  const uint64_t Start = afterRefresh(C, Now + P.ControllerPs);
  uint64_t Column = Start;
  if (B.IsOpen && B.Row == Row) {
    ++Counted.RowHits;
  } else {
    uint64_t Activate = std::max(Start, B.ActivateAt);
    if (B.IsOpen) {
      ++Counted.RowConflicts;
      Activate = std::max(Activate, std::max(Start, B.PrechargeAt) + P.TrpPs);
    } else {
      ++Counted.RowMisses;
    }
    const uint64_t At = activate(C, Activate);
    B.IsOpen = true;
    B.Row = Row;
    B.ColumnAt = At + P.TrcdPs;
    B.PrechargeAt = At + P.TrasPs;
  }
  Column = std::max(Column, B.ColumnAt);
  if (!IsWrite)
    Column = std::max(Column, C.ReadAfterWriteAt);

  const uint64_t Wanted = (Column + P.TclPs + P.BurstPs - 1) / P.BurstPs;
  const uint64_t Data = C.Data.take(Wanted, BurstsPerLine) * P.BurstPs;
  const uint64_t Length = uint64_t{BurstsPerLine} * P.BurstPs;
  const uint64_t End = Data + Length;
  const uint64_t Issued = Data > P.TclPs ? Data - P.TclPs : 0;
  B.PrechargeAt =
      std::max(B.PrechargeAt, IsWrite ? End + P.TwrPs : Issued + P.TrtpPs);
  if (IsWrite) {
    C.ReadAfterWriteAt = std::max(C.ReadAfterWriteAt, End + P.TwtrPs);
    Counted.Writes += BurstsPerLine;
  } else {
    Counted.Reads += BurstsPerLine;
  }
  Counted.BusPs += Length;
  return End;
}

} // namespace vorion::isasim
