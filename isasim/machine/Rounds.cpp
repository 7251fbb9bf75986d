// A run's rounds: the cores run side by side for a quantum, then what they
// parked happens in a fixed order (docs/abi.md), then the run's end is decided.
#include "core/Atomics.h"
#include "core/Csr.h"
#include "machine/MachineImpl.h"
#include "machine/Report.h"
#include "vorion/isasim/Launch.h"
#include "vorion/isasim/Observer.h"
#include "vorion/isasim/TrapCause.h"

#include <algorithm>
#include <array>
#include <bit>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

/// Below this many warp instructions in a round of all cores, waking a second
/// host thread costs more than it saves.
constexpr uint64_t ShortRound = 20000;

// What the clock has to know of parked instructions. For an atomic before it is
// executed, since its result may overwrite its addresses.

void traceAtomic(WarpState &S) {
  traceParked(&S, S.Next, Event::Atomic);
  traceAccess(&S, S.lanes(S.Next->Rs1), bytesOf(amoKind(S.Next)), false, true);
}

void traceBarrier(WarpState &S) {
  const uint32_t Words[] = {S.BarrierId, S.BarrierCount};
  if (S.Trace)
    traceParked(&S, S.Next, Event::Barrier, Words);
}

/// A status that says done is a wait (docs/adr/0007-the-clock.md).
Event rasterEvent(const WarpState &S) {
  const CsrAccess A = csrAccess(S.Next);
  switch (static_cast<raster::Csr>(A.Number)) {
  case raster::Csr::Start:
    return A.Writes ? Event::RasterStart : Event::RasterOther;
  case raster::Csr::Wait:
  case raster::Csr::Status:
    return Event::RasterWait;
  case raster::Csr::GradNext:
    return Event::RasterTake;
  default:
    return Event::RasterOther;
  }
}

} // namespace

RunMemory Machine::Impl::memoryFor(uint32_t LaunchBlock,
                                   const VxLaunch &Launch) const {
  RunMemory R{Shape.StackBytes, stackBytes(Shape), {}};
  // Whoever wrote the block has seen to it that the stacks fit (Launch::plan).
  constexpr uint64_t MostStacks = VX_STACK_TOP - VX_HIGH_BASE;
  const auto SetStacks = [&](uint32_t Each, uint64_t All) {
    if (std::has_single_bit(Each) && Each > Shape.StackBytes &&
        Each <= VX_MAX_STACK && All <= MostStacks)
      R.StackBytes = Each, R.Stacks = All;
  };
  if (LaunchBlock == 0) {
    const uint32_t Each = stackFor(Program->mainStackBytes(), Shape);
    SetStacks(Each, stackBytes(Shape) / Shape.StackBytes * Each);
    return R;
  }
  SetStacks(Launch.StackBytes, stackBytes(Shape, Launch.StackBytes,
                                          Launch.Warps, Launch.NumGroups));
  R.ReadOnly.push_back(
      {LaunchBlock, uint64_t{sizeof(VxLaunch)} * std::max(Launch.Warps, 1U)});
  for (const Kernel &K : Program->kernels())
    if (K.Entry == Launch.Entry && K.ArgsBytes != 0)
      R.ReadOnly.push_back({Launch.Args, alignLaunch(K.ArgsBytes)});
  return R;
}

void Machine::Impl::resetCores(uint32_t LaunchBlock, const VxLaunch &Launch) {
  const uint32_t Entry =
      Launch.Warps > 1 ? Program->warpsEntry() : Program->entry();
  const bool Observed = isObserved();
  const bool IsTranslated =
      unitOf(Shape.Runs) != VectorUnit::None && !Observed && !isClocked();
  Present = &Programs.get(Program, exec(), IsTranslated);
  const CodeTable &Code = Present->Code;
  if (Observed)
    Watcher.prepare(Code, Shape.WarpsPerCore, Shape.cores());
  Storage->clearLocal();
  for (const auto &C : Cores)
    C->reset(Code, Entry, LaunchBlock, Launch.Warps, Storage->view(C->id()),
             Observed ? &Watcher : nullptr);
  if (isClocked()) {
    Time->begin(Code);
    for (const auto &C : Cores)
      for (unsigned W = 0; W != Shape.WarpsPerCore; ++W)
        C->setTrace(W, Time->trace(C->id(), W));
  }
  GlobalArrived.assign(Shape.Barriers, 0);
  Hang = HangDetector();
  Host.reset(*Program);
  LastRound = ShortRound;
}

uint64_t Machine::Impl::retired() const {
  uint64_t Sum = 0;
  for (const auto &C : Cores)
    Sum += C->retired();
  return Sum;
}

const ExecTable &Machine::Impl::exec() const {
  return isObserved() || !isClocked() ? execTable(isObserved())
                                      : timedExecTable();
}

/// Rasterizers and pixel units say what they do where somebody wants to know.
void Machine::Impl::chooseLog() {
  Raster.setLog(isObserved() || isClocked() ? this : nullptr);
}

// Observers follow runs, not what the driver does between them.

void Machine::Impl::part(const raster::CommandWork &Begun,
                         std::vector<raster::GaussianWork> &&Fetched) {
  Time->expectPart(Begun, std::move(Fetched));
}

void Machine::Impl::command(raster::CommandWork &&Work) {
  if (Budget.isRunning())
    Watcher.tell([&](Observer &O) { O.rasterCommand(Work); });
  if (!isClocked())
    return;
  // Nobody who watches the clock looks at these.
  Work.Pushed = {};
  Time->expect(std::move(Work));
}

void Machine::Impl::tail(raster::TailWork &&Work) {
  if (Budget.isRunning())
    Watcher.tell([&](Observer &O) { O.tail(Work); });
  if (isClocked())
    Time->expect(std::move(Work));
}

void Machine::Impl::resetRasterizers() {
  Raster.reset();
  if (Time)
    Time->reset();
}

void Machine::Impl::tellTimeObservers() {
  if (Time)
    Time->setObservers(Mode == Clocking::On ? TimeObservers
                                            : std::vector<TimeObserver *>());
}

void Machine::Impl::publishTime() {
  for (const auto &C : Cores)
    Time->setEnded(C->id(), C->endedWarps());
  Time->publish();
}

void Machine::Impl::takeTime() {
  if (!isClocked())
    return;
  publishTime();
  if (Time->isWatched() && Time->isWorthTaking())
    Time->take();
}

/// Has the clock go on until it has room for what rasterizers do next. False if
/// it has.
bool Machine::Impl::makeRoomInTime() {
  if (!isClocked() || Time->hasRoom())
    return false;
  publishTime();
  Time->take();
  return true;
}

void Machine::Impl::endTime(RunResult &R) {
  if (!isClocked())
    return;
  std::optional<TimeReport> Took = Time->end();
  const bool IsWhole = Took.has_value();
  if (Mode == Clocking::On)
    R.Time = std::move(Took);
  // The clock was behind the cores, and did not get to the end in time.
  if (!IsWhole && R.End == Outcome::Done) {
    R.End = Outcome::LimitReached;
    R.Report = Budget.reason() + "\n" + warpReport(Cores, Program);
  }
}

/// The clock takes what the last round wrote while the cores write the next
/// one.
void Machine::Impl::runCores() {
  const uint64_t Before = retired();
  uint64_t Quantum = Shape.Quantum;
  if (Shape.MaxInstructions)
    Quantum = std::clamp<uint64_t>(Shape.MaxInstructions - Before, 1, Quantum);
  std::vector<Core *> Ready;
  for (const auto &C : Cores)
    if (C->isReady())
      Ready.push_back(C.get());
  const ExecTable &Exec = exec();
  const unsigned Takes = isClocked() && Time->isWorthTaking() ? 1 : 0;
  const bool Alone = isObserved() || (LastRound < ShortRound && !Takes);
  // The clock first: it is the longest task.
  Pool.run(static_cast<unsigned>(Ready.size()) + Takes, Alone, [&](unsigned N) {
    if (N < Takes)
      Time->take();
    else
      Ready[N - Takes]->runRound(Exec, static_cast<uint32_t>(Quantum),
                                 [this] { return Budget.mustStop(); });
  });
  LastRound = retired() - Before;
  if (Present->Translated)
    translate();
}

/// The ends of stretches are where warps are most of the time.
void Machine::Impl::translate() {
  for (const auto &C : Cores)
    for (const Core::Stretch &S : C->stretches())
      Present->Translated->seen(S.End, S.Executed, S.Of);
}

void Machine::Impl::arriveGlobally(WarpState &S) {
  if (S.AtBarrier)
    return;
  S.AtBarrier = true;
  Progress = true;
  if (++GlobalArrived[S.BarrierId] < S.BarrierCount)
    return;
  GlobalArrived[S.BarrierId] = 0;
  for (const auto &C : Cores)
    for (WarpState &Other : C->warps())
      if (Other.Why == Stop::GlobalBarrier && Other.AtBarrier &&
          Other.BarrierId == S.BarrierId && &Other != &S) {
        traceBarrier(Other);
        Core::complete(Other);
      }
  traceBarrier(S);
  Core::complete(S);
}

void Machine::Impl::executeParked(Core &C, WarpState &S) {
  switch (S.Why) {
  case Stop::Atomic:
    if (S.Trace)
      traceAtomic(S);
    if (amoNow(&S, S.Next, amoKind(S.Next)))
      Core::complete(S);
    break;
  case Stop::RasterCsr:
    if (Raster.access(C.id(), &S, csrAccess(S.Next))) {
      if (S.Trace)
        traceParked(&S, S.Next, rasterEvent(S));
      Progress = true;
      Core::complete(S);
    }
    break;
  case Stop::GlobalBarrier:
    arriveGlobally(S);
    break;
  default:
    break;
  }
}

void Machine::Impl::atSyncPoint() {
  Progress |= Host.poll();
  flushConsole(false);
  Watcher.tell([&](Observer &O) { O.syncPoint(Cores); });
  for (const auto &C : Cores)
    for (WarpState &S : C->warps())
      executeParked(*C, S);
  if (!Raster.canRun())
    return;
  Progress = true;
  runRasterizers();
}

/// As a whole, whatever the clock has room for: function does not depend on it.
void Machine::Impl::runRasterizers() {
  do {
    Pool.run(Raster.units(), isObserved(),
             [&](unsigned N) { Raster.runUnit(N); });
  } while (makeRoomInTime() && Raster.canRun());
  Raster.handOver();
  while (Raster.canRunPixelUnits()) {
    Pool.run(Raster.pixelUnits(), isObserved(),
             [&](unsigned N) { Raster.runPixelUnit(N); });
    makeRoomInTime();
  }
}

void Machine::Impl::flushConsole(bool All) {
  for (const auto &C : Cores)
    flushConsole(*C, All);
}

void Machine::Impl::flushConsole(Core &Of, bool All) {
  const size_t Length = All || Of.Console.size() > HostBudget::ConsoleBytes
                            ? Of.Console.size()
                            : Of.Console.find_last_of('\n') + 1;
  if (Length == 0)
    return;
  if (Console)
    Console(std::string_view(Of.Console).substr(0, Length));
  Of.Console.erase(0, Length);
}

/// The host interface prints as the first core.
void Machine::Impl::printOfHost(std::string_view Text) {
  Cores[0]->Console += Text;
  if (Cores[0]->Console.size() > HostBudget::ConsoleBytes)
    flushConsole(*Cores[0], false);
}

bool Machine::Impl::findTrap(RunResult &R) {
  for (const auto &C : Cores)
    for (const WarpState &S : C->warps())
      if (S.Why == Stop::Trapped) {
        R.End = Outcome::Trap;
        R.Fault = makeTrap(S, Program);
        R.Report = trapReport(R.Fault);
        Watcher.tell([&](Observer &O) { O.trap(R.Fault); });
        return true;
      }
  return false;
}

bool Machine::Impl::decideEnd(RunResult &R) {
  if (findTrap(R))
    return true;
  const auto Ended = [](const auto &C) { return C->hasEnded(); };
  if (Host.exitCode() || std::all_of(Cores.begin(), Cores.end(), Ended))
    return true;
  // After parked operations have been executed, what can still go on is either
  // ready or waits for a rasterizer.
  bool CanGoOn = false;
  for (const auto &C : Cores)
    for (const WarpState &S : C->warps())
      CanGoOn |= S.Why == Stop::Ready || S.Why == Stop::RasterCsr;
  if (!CanGoOn || Hang.check(Cores, Progress)) {
    R.End = Outcome::Hang;
    R.Report =
        (CanGoOn
             ? "no warp can make progress: the state of the machine repeats\n"
             : "all warps wait for each other\n") +
        warpReport(Cores, Program);
    return true;
  }
  std::string Limit;
  if (Shape.MaxInstructions && retired() >= Shape.MaxInstructions)
    Limit = fmt::format("{} instructions, the maximum", Shape.MaxInstructions);
  else
    Limit = Budget.reason();
  if (!Limit.empty()) {
    R.End = Outcome::LimitReached;
    R.Report = Limit + "\n" + warpReport(Cores, Program);
    return true;
  }
  Progress = false;
  return false;
}

static bool isOfAccess(uint32_t Cause) {
  constexpr std::array Causes = {
      TrapCause::LoadFault, TrapCause::MisalignedLoad, TrapCause::StoreFault,
      TrapCause::MisalignedStore, TrapCause::StackOverflow};
  return std::ranges::find(Causes, static_cast<TrapCause>(Cause)) !=
         Causes.end();
}

/// The counters of a warp. Loads, stores and atomics count when they begin; one
/// that trapped was not executed, and does not count, as other instructions.
static CoreCounters countersOf(const WarpState &S) {
  CoreCounters Counted = S.Count;
  if (S.Why != Stop::Trapped || !isOfAccess(S.FaultCause))
    return Counted;
  MemoryAccess Access;
  const std::optional<Decoded> D = decode(S.Next->Word);
  if (!D || !describeAccess(*D, Access))
    return Counted;
  --(Access.What == MemoryAccess::Load    ? Counted.Loads
     : Access.What == MemoryAccess::Store ? Counted.Stores
                                          : Counted.Atomics);
  return Counted;
}

void Machine::Impl::count(RunResult &R) const {
  for (const auto &C : Cores) {
    CoreCounters Sum;
    for (const WarpState &S : C->warps())
      Sum += countersOf(S);
    R.Total += Sum;
    R.Cores.push_back(Sum);
    if (C->ExitCode && R.ExitCode == 0)
      R.ExitCode = *C->ExitCode;
  }
  if (Host.exitCode())
    R.ExitCode = *Host.exitCode();
}

} // namespace vorion::isasim
