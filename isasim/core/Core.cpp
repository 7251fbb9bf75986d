#include "core/Core.h"

#include "core/HostFp.h"
#include "core/Slow.h"
#include "vorion/isasim/TrapCause.h"

#include <algorithm>

namespace vorion::isasim {

Core::Core(const Config &C, unsigned IdIn)
    : Shape(C), Id(IdIn), Warps(C.WarpsPerCore),
      Stacks(size_t{C.WarpsPerCore} * C.DivergenceDepth), Arrived(C.Barriers) {}

void Core::reset(const CodeTable &CodeIn, uint32_t Entry,
                 uint32_t LaunchBlockIn, const MemoryView &ViewIn,
                 Watch *Watcher) {
  Code = &CodeIn;
  View = ViewIn;
  LaunchBlock = LaunchBlockIn;
  Console.clear();
  ExitCode.reset();
  std::fill(Arrived.begin(), Arrived.end(), 0);
  for (unsigned W = 0; W != Warps.size(); ++W) {
    WarpState &S = Warps[W];
    S = WarpState();
    std::fill(std::begin(S.R), std::end(S.R), LaneWords{});
    S.Code = Code->begin();
    S.CodeLo = Code->low();
    S.CodeCount = Code->count();
    S.Mem = &View;
    S.Stack = Stacks.data() + size_t{W} * Shape.DivergenceDepth;
    S.StackLimit = Shape.DivergenceDepth;
    S.AllLanes = (1U << Shape.LanesPerWarp) - 1;
    S.WarpId = W;
    // docs/abi.md, "Memory map". With several warps a core nothing says which
    // stacks are whose.
    if (Warps.size() == 1)
      S.FirstStack = Id * Shape.LanesPerWarp;
    S.Owner = this;
    S.Watcher = Watcher;
    S.Next = Code->begin();
  }
  Warps[0].Next = Code->find(Entry);
  Warps[0].Why = Stop::Ready;
  setMask(&Warps[0], 1);
}

void Core::runRound(const ExecTable &Exec, uint32_t QuantumIn) {
  const HostFp Host;
  Quantum = QuantumIn;
  for (WarpState &S : Warps)
    S.RetireLimit = S.Count.Retired + Quantum;
  // A barrier may release warps that have had their turn.
  for (bool Ran = true; Ran;) {
    Ran = false;
    for (WarpState &S : Warps) {
      if (S.Why != Stop::Ready || S.Count.Retired >= S.RetireLimit)
        continue;
      setFrm(&S, S.Frm);
      Exec.Enter(&S);
      S.Fflags |= HostFp::takeFlags();
      Ran = true;
    }
  }
}

bool Core::isReady() const {
  return std::any_of(Warps.begin(), Warps.end(),
                     [](const WarpState &S) { return S.Why == Stop::Ready; });
}

bool Core::hasEnded() const {
  return std::all_of(Warps.begin(), Warps.end(),
                     [](const WarpState &S) { return S.Why == Stop::Ended; });
}

uint64_t Core::retired() const {
  uint64_t Sum = 0;
  for (const WarpState &S : Warps)
    Sum += S.Count.Retired;
  return Sum;
}

void Core::complete(WarpState &S) {
  if (VORION_OBSERVERS && S.Watcher)
    observeCommit(&S, S.Next);
  ++S.Count.Retired;
  S.Count.LaneRetired += S.LaneCount;
  ++S.Next;
  S.Why = Stop::Ready;
  S.AtBarrier = false;
}

void Core::spawn(uint32_t Count, uint32_t Entry) {
  const auto Limit = std::min<size_t>(Count, Warps.size());
  for (size_t W = 1; W < Limit; ++W) {
    WarpState &S = Warps[W];
    if (S.Why != Stop::Ended)
      continue; // vx_wspawn starts warps, it does not stop them
    S.Next = Code->find(Entry);
    S.Why = Stop::Ready;
    S.StackDepth = 0;
    S.RetireLimit = S.Count.Retired + Quantum;
    setMask(&S, 1);
  }
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
  if (Count <= 1)
    return true;
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
    if (Other.Why == Stop::LocalBarrier && Other.BarrierId == Number)
      complete(Other);
  return true;
}

uint32_t Core::activeWarps() const {
  uint32_t Mask = 0;
  for (size_t W = 0; W != Warps.size(); ++W)
    if (Warps[W].Why != Stop::Ended)
      Mask |= 1U << W;
  return Mask;
}

void Core::exitWith(uint32_t Value) {
  if (Value != 0 && !ExitCode)
    ExitCode = Value;
}

} // namespace vorion::isasim
