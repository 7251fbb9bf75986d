#include "timing/CoreClock.h"

#include <algorithm>
#include <bit>

namespace vorion::isasim {

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
  InFlight.clear();
  Spent = {};
  Classes = {};
  LinesRequested = LocalConflicts = 0;
  spend(CoreCycle::Start, P.StartCycles);
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

void CoreClock::waitForOperands(const OpInfo &O) {
  unsigned Latest = O.Rd;
  for (const uint8_t S : O.Sources)
    if (Ready[S] > Ready[Latest])
      Latest = S;
  waitUntil(Ready[Latest], ReadyWhy[Latest]);
  waitUntil(UnitFree[size_t(O.On)], CoreCycle::Unit);
}

void CoreClock::waitForLsu() {
  std::erase_if(InFlight, [this](uint64_t Done) { return Done <= Next; });
  if (InFlight.size() < P.LsuQueue)
    return;
  const auto First = std::min_element(InFlight.begin(), InFlight.end());
  waitUntil(*First, CoreCycle::LsuQueue);
  InFlight.erase(First);
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

void CoreClock::localAccess(const OpInfo &O, AccessWord A) {
  // A bank gives a word a cycle.
  UnitFree[size_t(Unit::Lsu)] = Next + A.Conflicts;
  LocalConflicts += A.Conflicts - 1;
  setReady(O.Rd, Next + A.Conflicts - 1 + P.LocalLatency, CoreCycle::Local);
  issue(O);
}

/// Does one instruction, or stops in front of its request; false then.
bool CoreClock::advanceOne(const OpInfo &O) {
  waitForOperands(O);
  switch (O.Class) {
  case OpClass::Load:
  case OpClass::Store:
  case OpClass::Atomic: {
    const auto A = std::bit_cast<AccessWord>(Trace.word());
    if (A.Lines == 0) {
      Trace.popWords(1);
      localAccess(O, A);
      return true;
    }
    waitForLsu();
    At = Next;
    Waiting = &O;
    Now = State::Access;
    return false;
  }
  case OpClass::Fence:
    waitUntil(quietAt(), CoreCycle::Fence);
    break;
  default:
    break;
  }
  const uint64_t Issued = Next;
  UnitFree[size_t(O.On)] = Issued + O.Interval;
  setReady(O.Rd, Issued + O.Latency, CoreCycle::Operand);
  issue(O);
  return true;
}

/// An instruction that had parked; false if it is a request.
bool CoreClock::advanceParked(const RunRecord &R) {
  const OpInfo &O = (*Ops)[R.First];
  const auto Kind = static_cast<Event>(Trace.word());
  waitForOperands(O);
  Waiting = &O;
  switch (Kind) {
  case Event::Atomic:
    Trace.popWords(1);
    return advanceOne(O);
  case Event::Barrier:
    Words[0] = Trace.word(1);
    Words[1] = Trace.word(2);
    Trace.popWords(3);
    Now = State::Barrier;
    break;
  case Event::RasterStart:
    // It releases the core's earlier stores (docs/rasterizer.md).
    waitUntil(quietAt(), CoreCycle::Fence);
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
    issue(O);
    return true;
  }
  At = Next;
  return false;
}

void CoreClock::advance() {
  Now = State::Starved;
  while (!Trace.empty()) {
    const RunRecord R = Trace.front();
    if (!InRun)
      startRun(R);
    const unsigned Count = std::max<unsigned>(R.Count, 1);
    while (Position != Count) {
      // Moved on before the instruction: a request is finished elsewhere.
      const unsigned Here = Position++;
      if (!(R.Count == 0 ? advanceParked(R)
                         : advanceOne((*Ops)[R.First + Here])))
        return;
    }
    Expected = R.First + Count;
    Position = 0;
    InRun = false;
    Trace.pop();
  }
}

void CoreClock::access(MemorySystem &Memory) {
  const OpInfo &O = *Waiting;
  const auto A = std::bit_cast<AccessWord>(Trace.word());
  CacheRequest R{.Now = At + P.AguCycles, .Address = 0};
  if (O.Class == OpClass::Atomic) {
    R.Op = CacheOp::Atomic;
    R.Extra = A.Conflicts - 1;
  } else if (O.Class == OpClass::Store) {
    R.Op = A.Whole ? CacheOp::WriteWhole : CacheOp::Write;
  }
  uint64_t Done = 0;
  for (unsigned N = 0; N != A.Lines; ++N, ++R.Now) {
    R.Address = Trace.word(1 + N);
    Done = std::max(Done, Memory.access(Cluster, R));
  }
  LinesRequested += A.Lines;
  Trace.popWords(1 + A.Lines);
  UnitFree[size_t(Unit::Lsu)] = At + A.Lines;
  InFlight.push_back(Done);
  setReady(O.Rd, Done, CoreCycle::Memory);
  issue(O);
}

void CoreClock::resume(uint64_t Then, CoreCycle Why) {
  Blocked = false;
  waitUntil(Then, Why);
  setReady(Waiting->Rd, Next + Waiting->Latency, CoreCycle::Operand);
  issue(*Waiting);
}

uint64_t CoreClock::quietAt() const {
  uint64_t Last = Next;
  for (const uint64_t Done : InFlight)
    Last = std::max(Last, Done);
  return Last;
}

} // namespace vorion::isasim
