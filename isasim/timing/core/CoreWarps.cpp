/// A core of several warps: whose turn it is, and what warps do to each other.
#include "timing/core/CoreClock.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <utility>

namespace vorion::isasim {

void CoreClock::select(unsigned Warp) {
  if (Warp == Current)
    return;
  Others[Current] = std::move(static_cast<WarpTime &>(*this));
  static_cast<WarpTime &>(*this) = std::move(Others[Warp]);
  Current = Warp;
}

bool CoreClock::selectWaiting(unsigned Warp) {
  const WarpTime &W = of(Warp);
  if (!W.Blocked || W.Now == State::Barrier || W.Now == State::LocalBarrier ||
      W.Now == State::Fetch)
    return false;
  select(Warp);
  Presented = Now;
  return true;
}

/// Whether the next that is known of \p W is that another one starts it.
bool CoreClock::atSpawn(const WarpTime &W) const {
  return !W.InRun && W.Trace->front().Count == 0 &&
         static_cast<Event>(W.Trace->word()) == Event::Spawn;
}

/// When the instruction at \p W's position in \p R can issue, if no other
/// warp's comes in between; Turn::Never if memory has to answer first.
uint64_t CoreClock::earliestIssue(const WarpTime &W, const RunRecord &R) const {
  const OpInfo &O = (*Ops)[R.First + W.Position];
  uint64_t Then = std::max(Next, W.Fetched);
  Then = std::max({Then, W.Ready[O.Rd], W.Ready[O.HighRd]});
  for (const uint8_t S : O.Sources)
    Then = std::max(Then, W.Ready[S]);
  switch (O.Class) {
  case OpClass::Load:
  case OpClass::Store:
  case OpClass::Atomic: {
    // Behind the event, if it had parked.
    const auto A =
        std::bit_cast<AccessWord>(W.Trace->word(R.Count == 0 ? 1 : 0));
    Then = std::max(Then, lsuFreeAt());
    if (!needsPlace(O, A))
      return Then;
    const uint64_t Free = placeFreeAt(firstPlace());
    return Timing.LsuFront && (Free != Turn::Never || waitsInFront())
               ? Then
               : std::max(Then, Free);
  }
  case OpClass::Fence:
    return std::max(Then, quietAt());
  default:
    return std::max(Then, R.Count == 0 ? UnitFree[size_t(O.On)]
                                       : unitFreeAt(O, Next));
  }
}

/// When \p W does something next, Turn::Never if others have to come first.
uint64_t CoreClock::earliest(WarpTime &W) {
  if (W.Now != State::Starved)
    return std::max(Next, W.At);
  // A request has finished a run elsewhere.
  while (!W.Trace->empty() && W.InRun &&
         W.Position == std::max<unsigned>(W.Trace->front().Count, 1)) {
    W.Expected = W.Trace->front().First + W.Position;
    W.Position = 0;
    W.InRun = false;
    W.Trace->pop();
  }
  if (W.Trace->empty())
    return W.Ended ? Turn::Never : std::max(Next, W.Fetched);
  if (atSpawn(W)) {
    // It begins anew: neither a jump nor a change of lanes.
    W.Expected = ~0U;
    W.LastMask = W.Trace->front().Mask;
    return W.Spawns.empty() ? Turn::Never : std::max(Next, W.Spawns.front());
  }
  if (!W.InRun)
    startRun(W, W.Trace->front());
  if (!isInCode(W, W.Trace->front().First + W.Position))
    return W.At;
  return earliestIssue(W, W.Trace->front());
}

/// Each cycle's slot is given in turn to one of the warps with a decoded
/// instruction, whether or not it can issue. One that another warp starts needs
/// no slot.
IssueSlot IssueInTurn::firstSlot(uint64_t From, uint32_t Last,
                                 std::span<const WarpToIssue> All) const {
  IssueSlot Started;
  for (const WarpToIssue &S : All)
    if (S.DecodedAt == Turn::Never && S.ReadyAt < Started.Cycle)
      Started = {S.Warp, S.ReadyAt};
  const auto After = [&](uint32_t Previous, const WarpToIssue &S) {
    return (S.Warp + Warps - Previous - 1) % Warps;
  };
  for (uint64_t Begin = From; Begin < Started.Cycle;) {
    // Until another warp's instruction is decoded, the same warps take turns.
    uint64_t End = Turn::Never;
    unsigned Taking = 0;
    for (const WarpToIssue &S : All)
      if (S.DecodedAt <= Begin)
        ++Taking;
      else
        End = std::min(End, S.DecodedAt);
    IssueSlot First;
    uint32_t LastTaker = Last;
    for (const WarpToIssue &S : All) {
      if (S.DecodedAt > Begin)
        continue;
      unsigned Place = 0;
      for (const WarpToIssue &Other : All)
        Place +=
            Other.DecodedAt <= Begin && After(Last, Other) < After(Last, S);
      if (End != Turn::Never && (End - Begin - 1) % Taking == Place)
        LastTaker = S.Warp;
      uint64_t Slot = Begin + Place;
      if (S.ReadyAt == Turn::Never)
        continue;
      if (S.ReadyAt > Slot)
        Slot += (S.ReadyAt - Slot + Taking - 1) / Taking * Taking;
      if (Slot < End && Slot < First.Cycle)
        First = {S.Warp, Slot};
    }
    if (First.Cycle != Turn::Never)
      return First.Cycle < Started.Cycle ? First : Started;
    Last = LastTaker;
    Begin = End;
  }
  return Started;
}

IssueSlot IssuePolicy::first(uint64_t From, uint32_t Last,
                             std::span<const WarpToIssue> All) const {
  const IssueSlot S = ask([&](auto &P) { return P.first(From, Last, All); });
  if (isOwn())
    return S;
  const IssueSlot Own = own().first(From, Last, All);
  if (S.Cycle == Turn::Never && Own.Cycle == Turn::Never)
    return S;
  for (const WarpToIssue &W : All)
    if (W.Warp == S.Warp && S.Cycle >= std::max(From, W.ReadyAt) &&
        S.Cycle < Turn::Never)
      return S;
  notePolicyFault(
      S.Cycle == Turn::Never
          ? fmt::format("gives no warp of core {} a slot, expected one of "
                        "those that can issue",
                        Core)
          : fmt::format("gives warp {} of core {} the slot of cycle {}, "
                        "expected a warp that can issue then",
                        S.Warp, Core, S.Cycle));
  return Own;
}

/// When \p W has as many decoded instructions as its buffer holds, and one more
/// is fetched that has to wait in the decoder; Turn::Never if its front end
/// stops before. What follows the run is not known yet.
uint64_t CoreClock::fullAt(const WarpTime &W) const {
  const RunRecord R = W.Trace->front();
  if (!Timing.DecodeBlocks || W.Position + Timing.FetchAhead >= R.Count)
    return Turn::Never;
  for (unsigned N = 0; N != Timing.FetchAhead; ++N)
    if ((*Ops)[R.First + W.Position + N].Redirect)
      return Turn::Never;
  return W.Fetched + uint64_t{Timing.FetchInterval} * Timing.FetchAhead;
}

/// The warp whose instruction waits in the decoder first keeps it until it
/// issues: what others fetch later is not decoded.
void CoreClock::holdDecoder(unsigned Shared) {
  Held = 0;
  uint64_t FullAt = Turn::Never;
  for (unsigned N = 0; N != Shared; ++N)
    if (FullAts[N] < FullAt) {
      FullAt = FullAts[N];
      Holder = Sharing[N].Warp;
    }
  for (WarpToIssue &S : std::span(Sharing.data(), Shared))
    if (S.Warp != Holder && of(S.Warp).Decoded > FullAt) {
      Held |= 1U << S.Warp;
      S.DecodedAt = S.ReadyAt = Turn::Never;
    }
}

/// Goes on, always with the warp that can issue first, to the next request. A
/// warp that waits for others may go on before those of its core: then only
/// what is not later than \p Until is done.
void CoreClock::advanceInTurn(uint64_t Until) {
  const unsigned Count = warps();
  for (;;) {
    unsigned First = Count;
    uint64_t FirstAt = Turn::Never;
    bool FirstIsStarved = false, SomeWait = false;
    // At equal times a warp whose next instruction is unknown goes first,
    // because that instruction may be the earliest; then one with a request.
    const auto Consider = [&](unsigned N, uint64_t Then, bool IsRequest,
                              bool IsStarved) {
      if (Then < FirstAt || (Then == FirstAt && Then != Turn::Never &&
                             (IsStarved || (IsRequest && !FirstIsStarved)))) {
        First = N;
        FirstAt = Then;
        FirstIsStarved = IsStarved;
      }
    };
    unsigned Shared = 0;
    bool SomeStarved = false;
    for (unsigned K = 1; K <= Count; ++K) {
      const unsigned N = (LastIssued + K) % Count;
      WarpTime &W = of(N);
      if (W.Blocked) {
        SomeWait |= W.Now != State::LocalBarrier;
        continue;
      }
      const uint64_t Then = earliest(W);
      const bool IsRequest = W.Now != State::Starved;
      const bool IsStarved = !IsRequest && W.Trace->empty();
      // It waits for memory, or for a vx_wspawn.
      SomeWait |= Then == Turn::Never && !IsStarved;
      if (IsRequest) {
        Consider(N, Then, true, false);
        continue;
      }
      if (IsStarved && W.Ended)
        continue;
      SomeStarved |= IsStarved;
      // Who starts another warp's matters only to those who give slots.
      const bool IsStarted =
          IssueOrder.givesSlots() && !IsStarved && atSpawn(W);
      Sharing[Shared] = {N, IsStarted ? Turn::Never : std::max(Next, W.Fetched),
                         Then};
      if (Timing.IssueInTurn)
        FullAts[Shared] = IsStarved || IsStarted ? Turn::Never : fullAt(W);
      ++Shared;
    }
    if (Timing.IssueInTurn)
      holdDecoder(Shared);
    const std::span All(Sharing.data(), Shared);
    const IssueSlot Slot = IssueOrder.first(Next, LastIssued, All);
    if (Slot.Cycle != Turn::Never)
      Consider(Slot.Warp, Slot.Cycle, false, false);
    // Whether a warp goes on or has ended decides who shares the slots.
    if (SomeStarved)
      for (const WarpToIssue &S : All)
        if (of(S.Warp).Trace->empty() && S.DecodedAt != Turn::Never)
          Consider(S.Warp, S.DecodedAt, false, true);
    SlotAt = 0;
    Presented = State::Starved;
    InTurn = Turn(FirstAt, !FirstIsStarved);
    if (First == Count || FirstIsStarved)
      return;
    select(First);
    if (Now != State::Starved) {
      Presented = Now;
      return;
    }
    if (SomeWait && FirstAt > Until) {
      Presented = State::Step;
      return;
    }
    LastIssued = First;
    IssueOrder.issued(First, FirstAt);
    const bool IsSpawn = atSpawn(*this);
    if (IssueOrder.givesSlots() && !IsSpawn)
      SlotAt = Slot.Cycle;
    if (Held && First == Holder)
      for (unsigned N = 0; N != Count; ++N)
        if (Held >> N & 1)
          of(N).decodeNotBefore(SlotAt + 1, CoreCycle::Fetch);
    InRun = true;
    advanceFront();
    if (Now != State::Starved && !Blocked) {
      Presented = Now;
      InTurn = Turn(At);
      return;
    }
    if (IsSpawn) {
      Position = 0;
      InRun = false;
      Trace->pop();
    }
  }
}

/// vx_wspawn \p O of the current warp.
void CoreClock::spawn(const OpInfo &O) {
  const uint64_t Begun = pass(O);
  for (uint32_t Left = Trace->word(); Left; Left &= Left - 1)
    of(static_cast<unsigned>(std::countr_zero(Left)))
        .Spawns.push_back(Begun + std::max<unsigned>(O.Redirect, 1));
  Trace->popWords(1);
}

/// The current warp arrives at a barrier of its core, of \p Count warps. The
/// last one lets all go on.
void CoreClock::arrive(const OpInfo &O, uint32_t Barrier, uint32_t Count) {
  const uint64_t Begun = Next;
  finish(O);
  std::vector<unsigned> &Arrived = LocalBarriers[Barrier];
  if (Arrived.size() + 1 < Count) {
    Arrived.push_back(Current);
    Blocked = true;
    Now = State::LocalBarrier;
    return;
  }
  for (const unsigned Other : Arrived) {
    WarpTime &W = of(Other);
    W.Blocked = false;
    W.Now = State::Starved;
    W.decodeNotBefore(Begun + std::max<unsigned>(O.Redirect, 1),
                      CoreCycle::Barrier);
  }
  Arrived.clear();
}

} // namespace vorion::isasim
