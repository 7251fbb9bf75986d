/// A core's pipeline: what an instruction waits for, when it issues, and when
/// the next one has been fetched.
#include "timing/core/CoreClock.h"

#include <algorithm>
#include <bit>

namespace vorion::isasim {

/// Whether the line of \p Instruction is there for \p W, as far as the core
/// knows. If not, the warp asks for it next.
bool CoreClock::isInCode(WarpTime &W, uint32_t Instruction) const {
  const uint32_t Line = lineOfCode(Instruction);
  if (!AsksForCode || Line == W.CodeLine)
    return true;
  const Arrival &Ready = CodeReady[Line];
  if (Ready.At == Turn::Never) {
    W.Now = State::Fetch;
    W.At = std::max(Next, W.Fetched);
    W.Words[0] = Line;
    return false;
  }
  W.CodeLine = Line;
  if (Ready.At > W.Fetched)
    W.decodeNotBefore(Ready);
  return true;
}

/// Where, in a run from \p First on, the line of code of \p Position ends.
unsigned CoreClock::endOfLine(uint32_t First, unsigned Position) const {
  const uint32_t Line = lineOfCode(First + Position);
  return (Line + 1) * WordsOfLine - FirstWord - First;
}

/// The front end has lost time if the pc or the mask is not what it went on
/// with.
void CoreClock::startRun(WarpTime &W, const RunRecord &R) {
  W.InRun = true;
  const bool Jumped = R.First != W.Expected && W.Expected != ~0U;
  const bool Masked = R.Mask != W.LastMask;
  W.LastMask = R.Mask;
  W.Lanes = static_cast<unsigned>(std::popcount(R.Mask));
  CoreCycle Why = CoreCycle::Branch;
  uint64_t Lost = 0;
  if (Masked || (Jumped && W.LastClass == OpClass::Mask)) {
    Why = CoreCycle::Divergence;
    Lost = Timing.MaskPenalty;
  } else if (Jumped) {
    Lost = Timing.BranchPenalty;
  }
  if (IsAlone) {
    spend(Why, Lost);
  } else if (Lost) {
    // Other warps go on.
    W.Fetched = std::max(W.Fetched, Next) + Lost;
    W.FetchWhy = Why;
  }
}

[[gnu::always_inline]] inline bool CoreClock::waitForOperands(Front &F,
                                                              const OpInfo &O) {
  // The time first: which register it is matters only if it is to come, and
  // every step of that search would wait for the one before.
  const uint64_t Then =
      std::max({std::max(Ready[O.Rd], Ready[O.HighRd]), Ready[O.Sources[0]],
                std::max(Ready[O.Sources[1]], Ready[O.Sources[2]])});
  if (Then <= F.Next)
    return true;
  if (Then == Turn::Never) {
    Now = State::Answer;
    return false;
  }
  // Of several that come at that time, the reason is the destination's, then
  // the first source's.
  unsigned Latest = O.Rd;
  for (const uint8_t R :
       {O.Sources[2], O.Sources[1], O.Sources[0], O.HighRd, O.Rd})
    Latest = Ready[R] == Then ? R : Latest;
  if (ReadyWhy[Latest] == CoreCycle::Link)
    waitFor(F.Next, Then, Loaded[Current][Latest], CoreCycle::Memory);
  else
    waitUntil(F, Then, ReadyWhy[Latest]);
  return true;
}

bool CoreClock::waitUntilQuiet() {
  const uint64_t Quiet = quietAt();
  if (Quiet == Turn::Never) {
    Now = State::Answer;
    return false;
  }
  waitFor(Next, Quiet, LastDone, CoreCycle::Fence);
  return true;
}

/// The place for \p O, which begins at \p Begin or later: one that is free by
/// then, whichever, or else the one that is free first.
size_t CoreClock::placeOf(const OpInfo &O, uint64_t Begin) const {
  const UnitPlaces &P = Places[size_t(O.On)];
  if (P.FreeAt[P.Oldest] <= Begin)
    return P.Oldest;
  return static_cast<size_t>(
      std::min_element(P.FreeAt.begin(), P.FreeAt.end()) - P.FreeAt.begin());
}

/// When \p O, which could at \p Now, can leave for its unit, or for the queue
/// in front of it.
uint64_t CoreClock::unitFreeAt(const OpInfo &O, uint64_t Now) const {
  const auto On = size_t(O.On);
  if (Timing.UnitQueue && O.On != Port::Lsu)
    return Queues[On].oldest();
  uint64_t Free = UnitFree[On];
  if (O.Hold)
    Free = std::max(Free, Places[On].FreeAt[placeOf(O, std::max(Now, Free))]);
  return Free;
}

/// Whether nothing keeps \p O from its unit at \p Now. Most instructions keep
/// it for a cycle: then it is free for the next one, and nothing is written
/// down of them but the place that they take.
inline bool CoreClock::beginsAtOnce(uint64_t Now, const OpInfo &O) {
  if (!O.IsLight || Now < UnitsBusyUntil)
    return false;
  if (!O.Hold)
    return true;
  UnitPlaces &P = Places[size_t(O.On)];
  if (P.FreeAt[P.Oldest] > Now)
    return false;
  P.take(P.Oldest, Now + O.Hold);
  return true;
}

/// Waits until \p O can leave for its unit, or for the queue in front of it,
/// and returns when the unit begins.
[[gnu::always_inline]] inline uint64_t CoreClock::beginOnUnit(Front &F,
                                                              const OpInfo &O) {
  waitUntil(F, unitFreeAt(O, F.Next), CoreCycle::Unit);
  waitUntil(F, SlotAt, CoreCycle::Slot);
  const auto On = size_t(O.On);
  uint64_t Begun = std::max(F.Next, UnitFree[On]);
  if (O.Hold) {
    UnitPlaces &P = Places[On];
    const size_t Place = placeOf(O, Begun);
    Begun = std::max(Begun, P.FreeAt[Place]);
    P.take(Place, Begun + O.Hold);
  }
  UnitFree[On] = Begun + O.Interval;
  UnitsBusyUntil = std::max(UnitsBusyUntil, UnitFree[On]);
  if (Timing.UnitQueue && O.On != Port::Lsu)
    Queues[On].add(Begun);
  return Begun;
}

/// Behind \p O, which has issued and which its unit begins at \p Begun.
inline void CoreClock::fetchNext(Front &F, const OpInfo &O, uint64_t Begun) {
  if (O.Redirect) {
    Decoded = F.Fetched = Begun + O.Redirect;
    F.FetchWhy = O.Class == OpClass::Branch ? CoreCycle::Branch
                 : O.Class == OpClass::Csr  ? CoreCycle::Fetch
                                            : CoreCycle::Divergence;
    return;
  }
  Decoded = F.Fetched + Timing.FetchInterval;
  // Fetching stops while its buffer is full.
  const uint64_t Ahead =
      uint64_t{Timing.FetchInterval} * (Timing.FetchAhead - 1);
  F.Fetched =
      std::max(F.Fetched + Timing.FetchInterval + Ahead, F.Next - 1) - Ahead;
  F.FetchWhy = CoreCycle::Fetch;
}

/// Counts \p O as issued at Next.
inline void CoreClock::issue(Front &F, const OpInfo &O) {
  ClassCount &C = Classes[size_t(O.Class)];
  ++C.Warp;
  C.Lane += Lanes;
  LastClass = O.Class;
  ++Spent.Cycles[size_t(CoreCycle::Issue)];
  ++F.Next;
}

/// Issues a request's instruction, which its unit begins at once.
void CoreClock::finish(const OpInfo &O) {
  Front F = front();
  issue(F, O);
  if (!IsIdeal)
    fetchNext(F, O, Next);
  setFront(F);
  if (Watch)
    tell(&O);
}

/// When the LSU begins the access that issues at Next, which has a place from
/// \p Free on. Those behind it follow in order.
uint64_t CoreClock::beginAccess(uint64_t Free) const {
  return Timing.LsuFront ? std::max({Next, UnitFree[size_t(Port::Lsu)], Free})
                         : Next;
}

/// All words of the access \p O have left the LSU at \p Sent.
void CoreClock::endAccess(uint64_t Sent, const OpInfo &O) {
  UnitFree[size_t(Port::Lsu)] = Sent + O.Interval;
  if (Timing.LsuFront)
    Queues[size_t(Port::Lsu)].add(Sent);
}

/// The LSU begins \p O of \p Warp, which has place \p Place, at \p Begun.
/// Returns when it is done, as far as is known: see delayBehind().
uint64_t CoreClock::localAccess(const OpInfo &O, unsigned Warp, AccessWord A,
                                uint64_t Begun, unsigned Place) {
  // A bank gives a word a cycle.
  const uint64_t Words = (A.Conflicts - 1) * Timing.LocalConflictCycles;
  uint64_t Last = Begun + Words, Sent = Begun + A.Conflicts - 1;
  if (Timing.LaneBuffers) {
    Last = delayBehind(A.Conflicts, Begun) + Words;
    LocalWaits[OldestLocal] = {&O, Warp, Place, A.Conflicts, Last};
    OldestLocal = OldestLocal + 1 == LocalWaits.size() ? 0 : OldestLocal + 1;
    Sent = std::max(Begun, LocalWaits[OldestLocal].Last + 1);
  }
  endAccess(Sent, O);
  LocalConflicts += A.Conflicts - 1;
  return setLocal(of(Warp), O, Last);
}

/// The banks of local memory give the last word of \p O of \p W at \p Last.
uint64_t CoreClock::setLocal(WarpTime &W, const OpInfo &O, uint64_t Last) {
  const uint64_t Done = Last + Timing.LocalLatency;
  setReady(W, O.Rd, Done + O.Latency, CoreCycle::Local);
  setReady(W, O.HighRd, Done + O.Latency, CoreCycle::Local);
  return Done;
}

/// An access to local memory begins at \p Begun, of whose lanes \p Conflicts
/// meet in a bank. Returns when that is free for their last words: each lane
/// keeps its order, and among lanes the lowest is first. So the words of lower
/// lanes come before the last ones of the accesses that still wait.
uint64_t CoreClock::delayBehind(unsigned Conflicts, uint64_t Begun) {
  uint64_t Free = Begun;
  for (LocalWait &W : LocalWaits) {
    if (W.Last < Begun)
      continue;
    Free = std::max(Free, W.Last + 1);
    const unsigned Before = std::min(Conflicts, W.Conflicts - 1);
    if (Before == 0)
      continue;
    W.Last += Before;
    const uint64_t Done = setLocal(of(W.Warp), *W.Op, W.Last);
    if (W.Place != Timing.LsuQueue)
      InFlight.begin(W.Place, Done);
  }
  return Free;
}

/// Waits until \p O has been fetched and its operands are there; false if
/// nobody knows yet when that is.
template <bool Ideal>
[[gnu::always_inline]] inline bool CoreClock::reach(Front &F, const OpInfo &O) {
  if constexpr (!Ideal) {
    if (F.FetchWhy == CoreCycle::Link)
      waitFor(F.Next, F.Fetched, CodeCame, CoreCycle::Fetch);
    else
      waitUntil(F, F.Fetched, F.FetchWhy);
  }
  return waitForOperands(F, O);
}

bool CoreClock::reach(const OpInfo &O) {
  Front F = front();
  const bool IsReached = IsIdeal ? reach<true>(F, O) : reach<false>(F, O);
  setFront(F);
  return IsReached;
}

/// Behind \p O, which its unit begins at \p Begun.
template <bool Ideal>
[[gnu::always_inline]] inline void CoreClock::follow(Front &F, const OpInfo &O,
                                                     uint64_t Begun) {
  setReady(O.Rd, Begun + O.Latency, CoreCycle::Operand);
  issue(F, O);
  if constexpr (!Ideal)
    fetchNext(F, O, Begun);
}

/// Gives \p O to its unit; returns when that begins.
template <bool Ideal>
inline uint64_t CoreClock::pass(Front &F, const OpInfo &O) {
  uint64_t Begun = F.Next;
  if constexpr (Ideal) {
    waitUntil(F, UnitFree[size_t(O.On)], CoreCycle::Unit);
    Begun = F.Next;
    UnitFree[size_t(O.On)] = Begun + O.Interval;
  } else {
    Begun = beginOnUnit(F, O);
  }
  follow<Ideal>(F, O, Begun);
  return Begun;
}

uint64_t CoreClock::pass(const OpInfo &O) {
  Front F = front();
  const uint64_t Begun = IsIdeal ? pass<true>(F, O) : pass<false>(F, O);
  setFront(F);
  return Begun;
}

/// The plain instructions of \p Run from \p Position on, up to \p End. Returns
/// where it stopped: there is one of another kind, or one whose operands nobody
/// knows yet.
template <bool Ideal>
unsigned CoreClock::advancePlain(const OpInfo *Run, unsigned Position,
                                 unsigned End) {
  Front F = front();
  for (; Position != End; ++Position) {
    const OpInfo &O = Run[Position];
    if (!O.IsPlain || !reach<Ideal>(F, O))
      break;
    if (!Ideal && beginsAtOnce(F.Next, O)) {
      follow<Ideal>(F, O, F.Next);
    } else {
      Front There = F; // nobody else has the address of F
      pass<Ideal>(There, O);
      F = There;
    }
  }
  setFront(F);
  return Position;
}

/// Does one instruction, or stops in front of its request; false then.
bool CoreClock::advanceOne(const OpInfo &O) {
  if (!reach(O))
    return false;
  switch (O.Class) {
  case OpClass::Load:
  case OpClass::Store:
  case OpClass::Atomic: {
    const bool HasRoom = lsuFreeAt() != Turn::Never;
    if (HasRoom)
      waitForUnit(O);
    const auto A = std::bit_cast<AccessWord>(Trace->word());
    if (A.Lines == 0 && !needsPlace(O, A) && InFront.empty()) {
      Trace->popWords(1);
      LocalLanes += Lanes;
      localAccess(O, Current, A, beginAccess(0), Timing.LsuQueue);
      finish(O);
      return true;
    }
    At = HasRoom ? Next : Turn::Never;
    Waiting = &O;
    Now = State::Access;
    return false;
  }
  case OpClass::Fence:
    if (!waitUntilQuiet())
      return false;
    break;
  case OpClass::Mask:
    if (O.Spawns) {
      spawn(O);
      return true;
    }
    break;
  case OpClass::Barrier: {
    const uint32_t Barrier = Trace->word(), Count = Trace->word(1);
    Trace->popWords(2);
    if (Count > 1) {
      waitForUnit(O);
      arrive(O, Barrier, Count);
      return true;
    }
    break;
  }
  default:
    break;
  }
  pass(O);
  return true;
}

/// An instruction that had parked; false if it is a request.
bool CoreClock::advanceParked(const OpInfo &O) {
  const auto Kind = static_cast<Event>(Trace->word());
  if (Kind == Event::Spawn) {
    Trace->popWords(1);
    decodeNotBefore(Spawns.front(), CoreCycle::Ended);
    Spawns.erase(Spawns.begin());
    return true;
  }
  if (!reach(O))
    return false;
  if (Kind == Event::Atomic) {
    Trace->popWords(1);
    return advanceOne(O);
  }
  waitForUnit(O);
  Waiting = &O;
  switch (Kind) {
  case Event::Atomic:
  case Event::Spawn:
    break; // above
  case Event::LocalBarrier: {
    const uint32_t Barrier = Trace->word(1), Count = Trace->word(2);
    Trace->popWords(3);
    arrive(O, Barrier, Count);
    return true;
  }
  case Event::Barrier:
    Words[0] = Trace->word(1);
    Words[1] = Trace->word(2);
    Trace->popWords(3);
    Now = State::Barrier;
    break;
  case Event::RasterStart:
    // It releases the core's earlier stores (docs/rasterizer.md).
    if (!waitUntilQuiet())
      return false;
    Trace->popWords(1);
    Now = State::RasterStart;
    break;
  case Event::RasterWait:
    Trace->popWords(1);
    Now = State::RasterWait;
    break;
  case Event::RasterTake:
    Trace->popWords(1);
    Now = State::RasterTake;
    break;
  case Event::RasterOther:
    Trace->popWords(1);
    UnitFree[size_t(O.On)] = Next + O.Interval;
    UnitsBusyUntil = std::max(UnitsBusyUntil, UnitFree[size_t(O.On)]);
    setReady(O.Rd, Next + O.Latency, CoreCycle::Operand);
    finish(O);
    return true;
  }
  At = Next;
  return false;
}

template <bool Ideal, bool Watched> void CoreClock::advanceThrough() {
  while (!Trace->empty()) {
    const RunRecord R = Trace->front();
    if (!InRun)
      startRun(*this, R);
    const OpInfo *const First = Ops->data() + R.First;
    const unsigned Count = std::max<unsigned>(R.Count, 1);
    unsigned Here = Position;
    while (Here != Count) {
      if constexpr (!Ideal)
        if (!isInCode(*this, R.First + Here)) {
          Position = Here;
          return;
        }
      if constexpr (!Watched)
        if (R.Count != 0) {
          const unsigned End =
              Ideal ? Count : std::min(Count, endOfLine(R.First, Here));
          Here = advancePlain<Ideal>(First, Here, End);
          if (Here == End)
            continue;
        }
      // Moved on before the instruction: a request is finished elsewhere.
      const OpInfo &O = First[Here++];
      if (!(R.Count == 0 ? advanceParked(O) : advanceOne(O))) {
        // What needs an answer is tried again.
        Position = Now == State::Answer ? Here - 1 : Here;
        return;
      }
      if constexpr (Watched)
        tell(&O);
    }
    Expected = R.First + Count;
    Position = 0;
    InRun = false;
    Trace->pop();
  }
}

/// The instruction at the current warp's position.
void CoreClock::advanceFront() {
  const RunRecord R = Trace->front();
  const OpInfo &O = (*Ops)[R.First + Position++];
  if (R.Count == 0)
    advanceParked(O);
  else
    advanceOne(O);
  if (Watch)
    tell(&O);
}

void CoreClock::advance() {
  if (!IsAlone)
    return advanceInTurn(0);
  if (Blocked)
    return;
  Now = State::Starved;
  if (Watch)
    IsIdeal ? advanceThrough<true, true>() : advanceThrough<false, true>();
  else
    IsIdeal ? advanceThrough<true, false>() : advanceThrough<false, false>();
}

} // namespace vorion::isasim
