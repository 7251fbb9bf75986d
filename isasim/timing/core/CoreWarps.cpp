/// A core of several warps: whose turn it is, and what warps do to each other.
#include "timing/core/CoreClock.h"

#include <algorithm>
#include <bit>
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
    Then = std::max(Then, UnitFree[size_t(Port::Lsu)]);
    return needsPlace(O, A) ? std::max(Then, placeFreeAt(firstPlace())) : Then;
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

/// The warp that issues first, and when, where each cycle's slot is given in
/// turn to one of the warps with a decoded instruction, whether or not it can
/// issue (`timing.core.issue_in_turn`). {warps(), Turn::Never} if no warp can.
std::pair<unsigned, uint64_t> CoreClock::firstInTurn() const {
  const unsigned Count = warps();
  const auto After = [&](unsigned Last, const SlotWarp &S) {
    return (S.Warp + Count - Last - 1) % Count;
  };
  unsigned Last = LastIssued;
  for (uint64_t Begin = Next; Begin != Turn::Never;) {
    // Until another warp's instruction is decoded, the same warps take turns.
    uint64_t End = Turn::Never;
    unsigned Taking = 0;
    for (const SlotWarp &S : Sharing)
      if (S.DecodedAt <= Begin)
        ++Taking;
      else
        End = std::min(End, S.DecodedAt);
    std::pair<unsigned, uint64_t> First(Count, Turn::Never);
    unsigned LastTaker = Last;
    for (const SlotWarp &S : Sharing) {
      if (S.DecodedAt > Begin)
        continue;
      unsigned Place = 0;
      for (const SlotWarp &Other : Sharing)
        Place +=
            Other.DecodedAt <= Begin && After(Last, Other) < After(Last, S);
      if (End != Turn::Never && (End - Begin - 1) % Taking == Place)
        LastTaker = S.Warp;
      uint64_t Slot = Begin + Place;
      if (S.ReadyAt == Turn::Never)
        continue;
      if (S.ReadyAt > Slot)
        Slot += (S.ReadyAt - Slot + Taking - 1) / Taking * Taking;
      if (Slot < End && Slot < First.second)
        First = {S.Warp, Slot};
    }
    if (First.first != Count)
      return First;
    Last = LastTaker;
    Begin = End;
  }
  return {Count, Turn::Never};
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
void CoreClock::holdDecoder() {
  Held = 0;
  uint64_t FullAt = Turn::Never;
  for (const SlotWarp &S : Sharing)
    if (S.FullAt < FullAt) {
      FullAt = S.FullAt;
      Holder = S.Warp;
    }
  for (SlotWarp &S : Sharing)
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
    Sharing.clear();
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
      if (!Timing.IssueInTurn || IsRequest ||
          (W.Trace->empty() ? W.Ended : atSpawn(W)))
        Consider(N, Then, IsRequest, IsStarved);
      else
        Sharing.push_back({N, std::max(Next, W.Fetched), Then,
                           IsStarved ? Turn::Never : fullAt(W)});
    }
    holdDecoder();
    const auto [Taker, Slot] = firstInTurn();
    if (Taker != Count)
      Consider(Taker, Slot, false, false);
    // Whether a warp goes on or has ended decides who shares the slots.
    for (const SlotWarp &S : Sharing)
      if (of(S.Warp).Trace->empty() && S.DecodedAt != Turn::Never)
        Consider(S.Warp, S.DecodedAt, false, true);
    SlotAt = First == Taker ? Slot : 0;
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
    if (Held && First == Holder)
      for (unsigned N = 0; N != Count; ++N)
        if (Held >> N & 1)
          of(N).decodeNotBefore(SlotAt + 1, CoreCycle::Fetch);
    const bool IsSpawn = atSpawn(*this);
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
