#include "core/Core.h"

#include "core/Atomics.h"
#include "core/HostFp.h"
#include "core/Observing.h"
#include "core/Rounding.h"
#include "core/Warps.h"
#include "timing/trace/TraceWriter.h"
#include "vorion/isasim/Launch.h"
#include "vorion/isasim/TrapCause.h"

#include <algorithm>

namespace vorion::isasim {

/// Instructions of a warp between two looks at whether the run must stop:
/// milliseconds with every checker on, far more than a look costs without.
static constexpr uint64_t LongestStretch = 1 << 14;

/// What is shorter says little of where the time goes.
static constexpr uint64_t ShortestStretch = 1 << 6;

/// A number that no stack has.
static constexpr uint32_t NoStack = 1U << 30;

Core::Core(const Config &C, unsigned IdIn)
    : Shape(C), Id(IdIn), Warps(C.WarpsPerCore),
      Stacks(size_t{C.WarpsPerCore} * C.DivergenceDepth), Arrived(C.Barriers) {}

void Core::reset(const CodeTable &CodeIn, uint32_t Entry,
                 uint32_t LaunchBlockIn, unsigned LaunchWarps,
                 const MemoryView &ViewIn, Watch *Watcher) {
  Code = &CodeIn;
  Local = ViewIn.Local;
  Views.assign(Warps.size(), ViewIn);
  LaunchBlock = LaunchBlockIn;
  Console.clear();
  ExitCode.reset();
  std::fill(Arrived.begin(), Arrived.end(), 0);
  for (unsigned W = 0; W != Warps.size(); ++W) {
    WarpState &S = Warps[W];
    S = WarpState();
    std::fill(std::begin(S.Registers), std::end(S.Registers), LaneWords{});
    S.Code = Code->begin();
    S.CodeLo = Code->low();
    S.CodeCount = Code->count();
    S.Mem = &Views[W];
    S.Stack = Stacks.data() + size_t{W} * Shape.DivergenceDepth;
    S.StackLimit = Shape.DivergenceDepth;
    S.AllLanes = (1U << Shape.LanesPerWarp) - 1;
    S.WarpId = W;
    // docs/abi.md, "Memory map". With several warps nothing but a launch says
    // which stacks are whose.
    if (LaunchWarps != 0 || Warps.size() == 1)
      S.FirstStack = (Id * std::max(LaunchWarps, 1U) + W) * Shape.LanesPerWarp;
    // Of a launch of few groups whose stacks are large, the first cores alone
    // have any.
    const uint32_t Known = ViewIn.Stack.Bytes >> ViewIn.StackShift;
    if (S.FirstStack != WarpState::NoOwnStack &&
        S.FirstStack + Shape.LanesPerWarp > Known)
      S.FirstStack = NoStack;
    S.KeepsStacks = LaunchWarps != 0;
    S.Owner = this;
    S.Watcher = Watcher;
    S.Next = Code->begin();
  }
  Warps[0].Next = Code->find(Entry);
  Warps[0].Why = Stop::Ready;
  setMask(&Warps[0], 1);
}

void Core::runRound(const ExecTable &Exec, uint32_t Quantum,
                    const std::function<bool()> &MustStop) {
  const HostFp Host;
  // All of them now: one that starts others again and again must not give them
  // more than one turn.
  for (WarpState &S : Warps)
    S.TurnEnd = S.Count.WarpInstructions + Quantum;
  Stretches.clear();
  // A barrier may release warps that have had their turn.
  for (bool Ran = true; Ran;) {
    Ran = false;
    for (WarpState &S : Warps)
      while (S.Why == Stop::Ready && S.Count.WarpInstructions < S.TurnEnd) {
        if (MustStop())
          return;
        const uint64_t Before = S.Count.WarpInstructions;
        S.RetireLimit = std::min(S.TurnEnd, Before + LongestStretch);
        setFrm(&S, S.Frm);
        Exec.Enter(&S);
        S.Fflags |= HostFp::takeFlags();
        const uint64_t Executed = S.Count.WarpInstructions - Before;
        if (Executed >= ShortestStretch && S.Why != Stop::Ended)
          Stretches.push_back({S.Next, Executed, &S});
        Ran = true;
      }
  }
}

void Core::runApart(WarpState &S, const ExecTable &Exec, uint64_t Most) {
  const HostFp Host; // keeps what it has of the warp that is running
  S.RetireLimit = S.Count.WarpInstructions + Most;
  setFrm(&S, S.Frm);
  Exec.Enter(&S);
  S.Fflags |= HostFp::takeFlags();
  if (S.Why == Stop::Atomic && amoNow(&S, S.Next, amoKind(S.Next)))
    complete(S);
}

bool Core::isReady() const {
  return std::any_of(Warps.begin(), Warps.end(),
                     [](const WarpState &S) { return S.Why == Stop::Ready; });
}

bool Core::hasEnded() const {
  return std::all_of(Warps.begin(), Warps.end(),
                     [](const WarpState &S) { return S.Why == Stop::Ended; });
}

uint32_t Core::endedWarps() const {
  uint32_t Ended = 0;
  for (size_t W = 0; W != Warps.size(); ++W)
    if (Warps[W].Why == Stop::Ended)
      Ended |= 1U << W;
  return Ended;
}

uint64_t Core::retired() const {
  uint64_t Sum = 0;
  for (const WarpState &S : Warps)
    Sum += S.Count.WarpInstructions;
  return Sum;
}

void Core::complete(WarpState &S) {
  if (VORION_OBSERVERS && S.Watcher)
    observeCommit(&S, S.Next);
  ++S.Count.WarpInstructions;
  S.Count.LaneInstructions += S.LaneCount;
  ++S.Next;
  S.Why = Stop::Ready;
  S.AtBarrier = false;
}

bool Core::spawn(WarpState &S, uint32_t Count, uint32_t Entry) {
  const auto Limit = std::min<size_t>(Count, Warps.size());
  uint32_t Started = 0;
  for (size_t W = 1; W < Limit; ++W) {
    WarpState &Other = Warps[W];
    if (Other.Why != Stop::Ended)
      continue; // vx_wspawn starts warps, it does not stop them
    const Insn *First = Code->find(Entry);
    // Here, where it is known who named it.
    if (First == Code->begin() + Code->count()) {
      raise(&S,
            static_cast<uint32_t>(Entry % 4 ? TrapCause::MisalignedFetch
                                            : TrapCause::FetchFault),
            S.LastLane, Entry);
      return false;
    }
    Other.Next = First;
    Other.Why = Stop::Ready;
    Other.StackDepth = 0;
    setMask(&Other, 1);
    Started |= 1U << W;
    if (Other.Trace)
      traceParked(&Other, First, Event::Spawn);
  }
  if (S.Trace)
    traceWords(&S, {&Started, 1});
  return true;
}

bool Core::arrive(WarpState &S, uint32_t BarrierId, uint32_t Count) {
  constexpr uint32_t GlobalBit = 1U << 31;
  const uint32_t Number = BarrierId & ~GlobalBit;
  if (S.Mask != S.WholeMask) {
    raise(&S, static_cast<uint32_t>(TrapCause::DivergentBarrier), S.LastLane,
          BarrierId);
    return false;
  }
  if (Number >= Shape.Barriers) {
    raise(&S, static_cast<uint32_t>(TrapCause::BadBarrier), S.LastLane,
          BarrierId);
    return false;
  }
  const uint32_t Words[] = {Number, Count};
  if (Count <= 1) {
    if (S.Trace)
      traceWords(&S, Words);
    return true;
  }
  S.BarrierId = Number;
  S.BarrierCount = Count;
  if (BarrierId & GlobalBit) {
    S.Why = Stop::GlobalBarrier;
    ++S.Count.Parks;
    return false;
  }
  if (++Arrived[Number] < Count) {
    S.Why = Stop::LocalBarrier;
    return false;
  }
  Arrived[Number] = 0;
  for (WarpState &Other : Warps)
    if (Other.Why == Stop::LocalBarrier && Other.BarrierId == Number) {
      if (Other.Trace)
        traceParked(&Other, Other.Next, Event::LocalBarrier, Words);
      complete(Other);
    }
  if (S.Trace)
    traceWords(&S, Words);
  return true;
}

void Core::moveLocal(WarpState &S, uint32_t Offset) {
  // A multiple of what a launch aligns parts of local memory to: what is left
  // then has room for any access (Region::Bytes), and the core's banks.
  constexpr uint32_t Step = LaunchAlignment;
  S.LocalOffset = Offset % Local.Bytes / Step * Step;
  Region &Own = Views[S.WarpId].Local;
  Own.Bytes = Local.Bytes - S.LocalOffset;
  Own.Host = Local.Host + S.LocalOffset;
}

uint32_t Core::activeWarps() const {
  return ~endedWarps() &
         static_cast<uint32_t>((uint64_t{1} << Warps.size()) - 1);
}

void Core::exitWith(uint32_t Value) {
  if (Value != 0 && !ExitCode)
    ExitCode = Value;
}

} // namespace vorion::isasim
