#include "timing/CoreClock.h"

#include <algorithm>
#include <bit>

namespace vorion::isasim {

CoreClock::CoreClock(const CoreTiming &Params, MemoryPort ToMemory,
                     TraceBuffer &TraceIn)
    : P(Params), IsIdeal(P.FetchInterval == 1 && P.BranchCycles == 1 &&
                         P.SplitCycles == 1 && P.JoinCycles == 1 &&
                         P.CsrCycles == 1 && P.UnitQueue == 0 && P.Fpu == 0),
      Trace(TraceIn), InFlight(ToMemory, P.LsuQueue + 1), Accesses(P.LsuQueue) {
}

void CoreClock::begin(const std::vector<OpInfo> &Program, uint64_t Start) {
  Ops = &Program;
  Now = State::Starved;
  Blocked = false;
  Next = At = Start;
  Position = 0;
  InRun = false;
  Expected = ~0U;
  LastMask = 1;
  LastClass = OpClass::Alu;
  Ready.fill(0);
  ReadyWhy.fill(CoreCycle::Operand);
  UnitFree.fill(0);
  for (UnitQueue &Q : Queues)
    Q = {std::vector<uint64_t>(P.UnitQueue), 0};
  Places[size_t(Port::Fpu)].assign(P.FpInFlight, 0);
  Places[size_t(Port::Alu)].assign(1, 0); // the divider
  for (unsigned N = 0; N <= P.LsuQueue; ++N)
    InFlight.begin(N);
  LastDone = 0;
  Spent = {};
  Classes = {};
  LinesRequested = LocalConflicts = 0;
  spend(CoreCycle::Start, P.StartCycles);
  Fetched = Next;
  FetchWhy = CoreCycle::Fetch;
}

/// The front end has lost time if the pc or the mask is not what it went on
/// with.
void CoreClock::startRun(const RunRecord &R) {
  InRun = true;
  const bool Jumped = R.First != Expected && Expected != ~0U;
  const bool Masked = R.Mask != LastMask;
  if (Masked || (Jumped && LastClass == OpClass::Mask))
    spend(CoreCycle::Divergence, P.MaskPenalty);
  else if (Jumped)
    spend(CoreCycle::Branch, P.BranchPenalty);
  LastMask = R.Mask;
  Lanes = static_cast<unsigned>(std::popcount(R.Mask));
}

bool CoreClock::waitForOperands(const OpInfo &O) {
  unsigned Latest = O.Rd;
  for (const uint8_t S : O.Sources)
    if (Ready[S] > Ready[Latest])
      Latest = S;
  if (Ready[Latest] == Turn::Never) {
    Now = State::Answer;
    return false;
  }
  waitUntil(Ready[Latest], ReadyWhy[Latest]);
  return true;
}

bool CoreClock::waitUntilQuiet() {
  const uint64_t Quiet = quietAt();
  if (Quiet == Turn::Never) {
    Now = State::Answer;
    return false;
  }
  waitUntil(Quiet, CoreCycle::Fence);
  return true;
}

/// Waits until \p O can leave for its unit, or for the queue in front of it,
/// and returns when the unit begins.
uint64_t CoreClock::beginOnUnit(const OpInfo &O) {
  const auto On = size_t(O.On);
  uint64_t Begun = std::max(Next, UnitFree[On]);
  uint64_t *Place = nullptr;
  if (O.Hold) {
    Place = &*std::min_element(Places[On].begin(), Places[On].end());
    Begun = std::max(Begun, *Place);
    *Place = Begun + O.Hold;
  }
  UnitFree[On] = Begun + O.Interval;
  if (P.UnitQueue == 0 || O.On == Port::Lsu) {
    waitUntil(Begun, CoreCycle::Unit);
    return Begun;
  }
  UnitQueue &Q = Queues[On];
  waitUntil(Q.Begins[Q.Next], CoreCycle::Unit);
  Q.Begins[Q.Next] = Begun;
  Q.Next = (Q.Next + 1) % P.UnitQueue;
  return Begun;
}

/// Behind \p O, which has issued and which its unit begins at \p Begun.
void CoreClock::fetchNext(const OpInfo &O, uint64_t Begun) {
  if (O.Redirect) {
    Fetched = Begun + O.Redirect;
    FetchWhy = O.Class == OpClass::Branch ? CoreCycle::Branch
               : O.Class == OpClass::Csr  ? CoreCycle::Fetch
                                          : CoreCycle::Divergence;
    return;
  }
  // Fetching stops while its buffer is full.
  const uint64_t Ahead = uint64_t{P.FetchInterval} * (P.FetchAhead - 1);
  Fetched = std::max(Fetched + P.FetchInterval + Ahead, Next - 1) - Ahead;
  FetchWhy = CoreCycle::Fetch;
}

void CoreClock::setReady(unsigned Register, uint64_t Then, CoreCycle Why) {
  if (Register == SinkRegister)
    return;
  Ready[Register] = Then;
  ReadyWhy[Register] = Why;
}

/// Counts \p O as issued at Next.
void CoreClock::issue(const OpInfo &O) {
  ClassCount &C = Classes[size_t(O.Class)];
  ++C.Warp;
  C.Lane += Lanes;
  LastClass = O.Class;
  spend(CoreCycle::Issue, 1);
}

/// Issues a request's instruction, which its unit begins at once.
void CoreClock::finish(const OpInfo &O) {
  const uint64_t Begun = Next;
  issue(O);
  if (!IsIdeal)
    fetchNext(O, Begun);
}

/// Returns when it is done.
uint64_t CoreClock::localAccess(const OpInfo &O, AccessWord A) {
  const uint64_t Done =
      Next + P.LocalLatency + (A.Conflicts - 1) * P.LocalConflictCycles;
  // A bank gives a word a cycle.
  UnitFree[size_t(Port::Lsu)] =
      Next + std::max<uint64_t>(A.Conflicts, O.Interval);
  LocalConflicts += A.Conflicts - 1;
  setReady(O.Rd, Done + O.Latency, CoreCycle::Local);
  finish(O);
  return Done;
}

/// Does one instruction, or stops in front of its request; false then.
template <bool Ideal> bool CoreClock::advanceOne(const OpInfo &O) {
  if constexpr (!Ideal)
    waitUntil(Fetched, FetchWhy);
  if (!waitForOperands(O))
    return false;
  switch (O.Class) {
  case OpClass::Load:
  case OpClass::Store:
  case OpClass::Atomic: {
    waitForUnit(O);
    const auto A = std::bit_cast<AccessWord>(Trace.word());
    if (A.Lines == 0 && !needsPlace(O, A)) {
      Trace.popWords(1);
      localAccess(O, A);
      return true;
    }
    At = Next;
    Waiting = &O;
    Now = State::Access;
    return false;
  }
  case OpClass::Fence:
    if (!waitUntilQuiet())
      return false;
    break;
  default:
    break;
  }
  uint64_t Begun = Next;
  if constexpr (Ideal) {
    waitForUnit(O);
    Begun = Next;
    UnitFree[size_t(O.On)] = Begun + O.Interval;
  } else {
    Begun = beginOnUnit(O);
  }
  setReady(O.Rd, Begun + O.Latency, CoreCycle::Operand);
  issue(O);
  if constexpr (!Ideal)
    fetchNext(O, Begun);
  return true;
}

/// An instruction that had parked; false if it is a request.
bool CoreClock::advanceParked(const OpInfo &O) {
  const auto Kind = static_cast<Event>(Trace.word());
  if (!IsIdeal)
    waitUntil(Fetched, FetchWhy);
  if (!waitForOperands(O))
    return false;
  if (Kind == Event::Atomic) {
    Trace.popWords(1);
    return IsIdeal ? advanceOne<true>(O) : advanceOne<false>(O);
  }
  waitForUnit(O);
  Waiting = &O;
  switch (Kind) {
  case Event::Atomic:
    break; // above
  case Event::Barrier:
    Words[0] = Trace.word(1);
    Words[1] = Trace.word(2);
    Trace.popWords(3);
    Now = State::Barrier;
    break;
  case Event::RasterStart:
    // It releases the core's earlier stores (docs/rasterizer.md).
    if (!waitUntilQuiet())
      return false;
    Trace.popWords(1);
    Now = State::RasterStart;
    break;
  case Event::RasterWait:
    Trace.popWords(1);
    Now = State::RasterWait;
    break;
  case Event::RasterTake:
    Trace.popWords(1);
    Now = State::RasterTake;
    break;
  case Event::RasterOther:
    Trace.popWords(1);
    UnitFree[size_t(O.On)] = Next + O.Interval;
    setReady(O.Rd, Next + O.Latency, CoreCycle::Operand);
    finish(O);
    return true;
  }
  At = Next;
  return false;
}

template <bool Ideal> void CoreClock::advanceThrough() {
  while (!Trace.empty()) {
    const RunRecord R = Trace.front();
    if (!InRun)
      startRun(R);
    const OpInfo *const First = Ops->data() + R.First;
    const unsigned Count = std::max<unsigned>(R.Count, 1);
    unsigned Here = Position;
    while (Here != Count) {
      // Moved on before the instruction: a request is finished elsewhere.
      const OpInfo &O = First[Here++];
      if (!(R.Count == 0 ? advanceParked(O) : advanceOne<Ideal>(O))) {
        // What needs an answer is tried again.
        Position = Now == State::Answer ? Here - 1 : Here;
        return;
      }
    }
    Expected = R.First + Count;
    Position = 0;
    InRun = false;
    Trace.pop();
  }
}

void CoreClock::advance() {
  Now = State::Starved;
  if (IsIdeal)
    advanceThrough<true>();
  else
    advanceThrough<false>();
}

bool CoreClock::access(MemorySystem &Memory) {
  const OpInfo &O = *Waiting;
  const auto A = std::bit_cast<AccessWord>(Trace.word());
  unsigned Place = P.LsuQueue;
  if (needsPlace(O, A)) {
    Place = 0;
    for (unsigned N = 1; N != P.LsuQueue; ++N)
      if (InFlight.readyAt(N) < InFlight.readyAt(Place))
        Place = N;
    if (const uint64_t Free = InFlight.readyAt(Place); Free > At) {
      At = Free;
      return false;
    }
    waitUntil(At, CoreCycle::LsuQueue);
    InFlight.begin(Place);
    Accesses[Place] = &O;
  }
  if (A.Lines == 0) {
    Trace.popWords(1);
    InFlight.begin(Place, localAccess(O, A));
    return true;
  }

  CacheRequest R{.Now = At + P.AguCycles, .Address = 0};
  if (O.Class == OpClass::Atomic) {
    R.Op = CacheOp::Atomic;
    R.Extra = A.Conflicts - 1;
  } else if (O.Class == OpClass::Store) {
    R.Op = A.Whole ? CacheOp::WriteWhole : CacheOp::Write;
  }
  uint32_t Room = P.LinesAtOnce;
  for (unsigned N = 0; N != A.Lines; ++N, --Room) {
    if (Room == 0) {
      R.Now += P.LineCycles;
      Room = P.LinesAtOnce;
    }
    R.Address = Trace.word(1 + N);
    InFlight.ask(Memory, Place, R);
  }
  const uint64_t Leaving = R.Now + P.LineCycles - (At + P.AguCycles);
  LinesRequested += A.Lines;
  Trace.popWords(1 + A.Lines);
  UnitFree[size_t(Port::Lsu)] = At + std::max<uint64_t>(Leaving, O.Interval);
  setLoaded(O, InFlight.readyAt(Place));
  finish(O);
  return true;
}

/// An access of \p O is done at \p Done, if that is known.
void CoreClock::setLoaded(const OpInfo &O, uint64_t Done) {
  if (Done == Turn::Never)
    return setReady(O.Rd, Done, CoreCycle::Memory);
  LastDone = std::max(LastDone, Done);
  setReady(O.Rd, Done + O.Latency, CoreCycle::Memory);
}

void CoreClock::answer(uint32_t Tag, uint64_t Then) {
  const std::optional<unsigned> Place = InFlight.answer(Tag, Then);
  if (!Place)
    return;
  const uint64_t Done = InFlight.readyAt(*Place);
  LastDone = std::max(LastDone, Done);
  if (*Place != P.LsuQueue) {
    setLoaded(*Accesses[*Place], Done);
    // The access in front may have waited for a place.
    At = std::min(At, std::max(Next, Done));
  }
  if (Now == State::Answer)
    advance();
}

void CoreClock::resume(uint64_t Then, CoreCycle Why) {
  Blocked = false;
  waitUntil(Then, Why);
  setReady(Waiting->Rd, Next + Waiting->Latency, CoreCycle::Operand);
  finish(*Waiting);
}

uint64_t CoreClock::quietAt() const {
  for (unsigned N = 0; N <= P.LsuQueue; ++N)
    if (InFlight.readyAt(N) == Turn::Never)
      return Turn::Never;
  return std::max(Next, LastDone);
}

} // namespace vorion::isasim
