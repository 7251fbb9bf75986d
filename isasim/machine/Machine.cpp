#include "vorion/isasim/Machine.h"

#include "core/Atomics.h"
#include "core/Core.h"
#include "core/Csr.h"
#include "core/Watch.h"
#include "machine/CodeCache.h"
#include "machine/HangDetector.h"
#include "machine/HostInterface.h"
#include "machine/RasterUnits.h"
#include "machine/Report.h"
#include "machine/WorkerPool.h"
#include "mem/Memory.h"
#include "timing/Clock.h"
#include "vorion/isasim/Observer.h"
#include "vorion/isasim/TrapCause.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

/// Below this many warp instructions in a round of all cores, waking a second
/// host thread costs more than it saves.
constexpr uint64_t ShortRound = 20000;

/// A core's console text goes out without its line's end when there is more.
constexpr size_t LongestLine = 64 << 10;

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

/// Whether the translator was asked for by name.
bool isTranslatorWanted(Engine E) {
  return E == Engine::Translator || E == Engine::TranslatorAvx2;
}

VectorUnit unitOf(Engine E) {
  const VectorUnit Best = Translator::unitOfHost();
  switch (E) {
  case Engine::Interpreter:
    return VectorUnit::None;
  case Engine::TranslatorAvx2:
    return std::min(Best, VectorUnit::Avx2);
  default:
    return Best;
  }
}

} // namespace

struct Machine::Impl final : raster::WorkLog {
  Impl(const Config &C, std::unique_ptr<Memory> Mem)
      : Shape(C), Storage(std::move(Mem)),
        Programs(isTranslatorWanted(C.Runs) ? 0 : Translator::UsualCost,
                 unitOf(C.Runs)),
        Pool(C.HostThreads),
        Raster(Shape, *Storage, [this] { return mustStop(); }),
        Host(*Storage, [this](char Byte) { Cores[0]->print(Byte); }) {
    for (unsigned Id = 0; Id != Shape.cores(); ++Id)
      Cores.push_back(std::make_unique<Core>(Shape, Id));
    if (Shape.Timing.Enabled)
      Time = std::make_unique<Clock>(Shape);
    chooseLog();
  }

  void command(raster::CommandWork &&Work) override;
  void tail(raster::TailWork &&Work) override;
  unsigned blockTests() const override {
    return isClocked() ? Shape.Timing.Raster.SkipBlocks : 0;
  }

  /// Calls Use(host address, offset, bytes) for the pieces of a range of
  /// global memory, the image or the stacks; false, and no call, if it is not
  /// all mapped.
  template <typename Function>
  bool access(uint32_t Address, uint64_t Bytes, Function Use) const;
  void resetCores(uint32_t LaunchBlock, const VxLaunch &Launch);
  void runCores();
  void translate();
  void atSyncPoint();
  void executeParked(Core &C, WarpState &S);
  void arriveGlobally(WarpState &S);
  void flushConsole(bool All);
  bool findTrap(RunResult &R);
  bool decideEnd(RunResult &R);
  void count(RunResult &R) const;
  bool isObserved() const { return !Watcher.Observers.empty(); }
  double secondsSoFar() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         Begin)
        .count();
  }
  bool stopRequested() const {
    return StopRequested.load(std::memory_order_relaxed);
  }
  bool watchdogExpired() const {
    return WatchdogSeconds > 0 && secondsSoFar() > WatchdogSeconds;
  }
  bool mustStop() const {
    return Running && (stopRequested() || watchdogExpired());
  }
  uint64_t retired() const;
  const ExecTable &exec() const;
  void chooseLog();
  void resetRasterizers();
  void takeTime();
  bool isClocked() const { return Time && Mode != Clocking::Off; }
  void tellTimeObservers();

  const Config Shape;
  std::unique_ptr<Memory> Storage;
  std::shared_ptr<const Image> Program;
  CodeCache Programs;
  CachedCode *Present = nullptr; ///< of the present run or the last one
  std::vector<std::unique_ptr<Core>> Cores;
  WorkerPool Pool;
  RasterUnits Raster;
  HostInterface Host;
  HangDetector Hang;
  Watch Watcher;
  double WatchdogSeconds = 0;
  std::chrono::steady_clock::time_point Begin; ///< of the run
  std::atomic<bool> StopRequested = false;
  bool Running = false;        ///< between the run's beginning and its end
  std::unique_ptr<Clock> Time; ///< if Shape.Timing.Enabled
  Clocking Mode = Clocking::On;
  std::vector<TimeObserver *> TimeObservers;
  std::function<void(std::string_view)> Console = [](std::string_view Text) {
    std::fwrite(Text.data(), 1, Text.size(), stdout);
    std::fflush(stdout);
  };
  std::vector<uint32_t> GlobalArrived; ///< by barrier
  uint64_t LastRound = 0;              ///< warp instructions
  bool Progress = false;               ///< see HangDetector
};

template <typename Function>
bool Machine::Impl::access(uint32_t Address, uint64_t Bytes,
                           Function Use) const {
  if (std::byte *At = Storage->shared(Address, Bytes)) {
    if (Bytes)
      Use(At, 0, Bytes);
    return true;
  }
  if (Bytes == 0 || Bytes > UINT32_MAX || !Storage->stackByte(Address) ||
      !Storage->stackByte(static_cast<uint32_t>(Address + Bytes - 1)))
    return false;
  for (uint32_t N = 0; N != Bytes; ++N)
    Use(Storage->stackByte(Address + N), N, 1);
  return true;
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

void Machine::Impl::command(raster::CommandWork &&Work) {
  if (Running)
    Watcher.tell([&](Observer &O) { O.rasterCommand(Work); });
  if (isClocked())
    Time->expect(std::move(Work));
}

void Machine::Impl::tail(raster::TailWork &&Work) {
  if (Running)
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

void Machine::Impl::takeTime() {
  if (!isClocked())
    return;
  for (const auto &C : Cores)
    Time->setEnded(C->id(), C->endedWarps());
  Time->publish();
  if (Time->isWatched() && Time->isWorthTaking())
    Time->take();
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
                                 [this] { return mustStop(); });
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
  Pool.run(Raster.units(), isObserved(),
           [&](unsigned N) { Raster.runUnit(N); });
  if (Raster.handOver())
    Pool.run(Raster.pixelUnits(), isObserved(),
             [&](unsigned N) { Raster.runPixelUnit(N); });
}

void Machine::Impl::flushConsole(bool All) {
  for (const auto &C : Cores) {
    const size_t Length = All || C->Console.size() > LongestLine
                              ? C->Console.size()
                              : C->Console.find_last_of('\n') + 1;
    if (Length == 0)
      continue;
    if (Console)
      Console(std::string_view(C->Console).substr(0, Length));
    C->Console.erase(0, Length);
  }
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
    R.Report = (CanGoOn ? "no warp can make progress: the machine repeats a "
                          "state with nothing changed\n"
                        : "all warps wait for each other\n") +
               warpReport(Cores, Program);
    return true;
  }
  std::string Limit;
  if (Shape.MaxInstructions && retired() >= Shape.MaxInstructions)
    Limit = fmt::format("{} instructions, as many as may run",
                        Shape.MaxInstructions);
  else if (stopRequested())
    Limit = "stopped from outside";
  else if (watchdogExpired())
    Limit =
        fmt::format("watchdog: the run took longer than {} s", WatchdogSeconds);
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

Machine::Machine() = default;
Machine::~Machine() = default;

Expected<std::unique_ptr<Machine>> Machine::create(const Config &C) {
  if (Expected<Success> Ok = validate(C); !Ok)
    return Ok.error();
  if (isTranslatorWanted(C.Runs) && !Translator::isThere())
    return Error{"configuration",
                 fmt::format("engine is the translator, expected 'auto' or "
                             "'interpreter' on this host: it needs {}",
                             Translator::needs()),
                 ExitCode::Usage};
  Expected<std::unique_ptr<Memory>> Mem = Memory::create(C);
  if (!Mem)
    return Mem.error();
  std::unique_ptr<Machine> M(new Machine());
  M->PImpl = std::make_unique<Impl>(C, std::move(*Mem));
  return M;
}

const Config &Machine::config() const { return PImpl->Shape; }

void Machine::load(std::shared_ptr<const Image> Program) {
  PImpl->Program = std::move(Program);
  PImpl->Storage->load(*PImpl->Program);
}

const std::shared_ptr<const Image> &Machine::image() const {
  return PImpl->Program;
}

std::byte *Machine::hostPointer(uint32_t Address, uint64_t Bytes) {
  return PImpl->Storage->global(Address, Bytes);
}

bool Machine::read(uint32_t Address, std::span<std::byte> To) const {
  return PImpl->access(Address, To.size(),
                       [&](std::byte *At, size_t Offset, size_t Bytes) {
                         std::memcpy(To.data() + Offset, At, Bytes);
                       });
}

bool Machine::write(uint32_t Address, std::span<const std::byte> From) {
  return PImpl->access(Address, From.size(),
                       [&](std::byte *At, size_t Offset, size_t Bytes) {
                         std::memcpy(At, From.data() + Offset, Bytes);
                       });
}

bool Machine::fill(uint32_t Address, uint64_t Bytes, std::byte Value) {
  return PImpl->access(Address, Bytes, [&](std::byte *At, size_t, size_t Part) {
    std::memset(At, static_cast<int>(Value), Part);
  });
}

RunResult Machine::run(uint32_t LaunchBlock) {
  RunResult R;
  if (!PImpl->Program) {
    R.End = Outcome::Trap;
    R.Fault.Cause = TrapCause::FetchFault;
    R.Report = "no program is loaded\n";
    return R;
  }
  PImpl->Begin = std::chrono::steady_clock::now();
  const std::clock_t CpuBegin = std::clock();
  PImpl->StopRequested = false;
  PImpl->Running = true;
  const RasterCounters Before = PImpl->Raster.counters();
  VxLaunch Launch{};
  const bool HasLaunch = LaunchBlock != 0;
  if (HasLaunch)
    read(LaunchBlock, std::as_writable_bytes(std::span(&Launch, 1)));
  PImpl->resetCores(LaunchBlock, Launch);
  PImpl->Watcher.tell([&](Observer &O) {
    O.runBegins({PImpl->Shape, PImpl->Program, LaunchBlock,
                 HasLaunch ? &Launch : nullptr, PImpl->Cores, this});
  });
  do {
    PImpl->runCores();
    ++R.SyncPoints;
    // A trap of the round comes before what others would do at its end.
    if (PImpl->findTrap(R))
      break;
    PImpl->atSyncPoint();
    PImpl->takeTime();
  } while (!PImpl->decideEnd(R));
  PImpl->Running = false;
  PImpl->flushConsole(true);
  PImpl->count(R);
  if (PImpl->isClocked()) {
    TimeReport Took = PImpl->Time->end();
    if (PImpl->Mode == Clocking::On)
      R.Time = std::move(Took);
  }
  if (R.End == Outcome::Done && R.ExitCode != 0)
    R.End = Outcome::GuestFailed;
  R.Raster = PImpl->Raster.counters() - Before;
  if (R.End != Outcome::Done && R.End != Outcome::GuestFailed)
    PImpl->resetRasterizers();
  R.HostSeconds = PImpl->secondsSoFar();
  R.HostCpuSeconds =
      static_cast<double>(std::clock() - CpuBegin) / CLOCKS_PER_SEC;
  PImpl->Watcher.tell([&](Observer &O) { O.runEnds(R); });
  return R;
}

void Machine::setConsole(std::function<void(std::string_view)> Sink) {
  PImpl->Console = std::move(Sink);
}

bool Machine::canBeObserved() { return VORION_OBSERVERS; }

void Machine::setObservers(std::vector<Observer *> Observers) {
  assert((Observers.empty() || canBeObserved()) &&
         "this build has no observers");
  PImpl->Watcher.Observers = std::move(Observers);
  PImpl->chooseLog();
}

void Machine::setTimeObservers(std::vector<TimeObserver *> Observers) {
  PImpl->TimeObservers = std::move(Observers);
  PImpl->tellTimeObservers();
}

void Machine::setWatchdog(double Seconds) { PImpl->WatchdogSeconds = Seconds; }

void Machine::requestStop() {
  PImpl->StopRequested.store(true, std::memory_order_relaxed);
}

bool Machine::mustStop() const { return PImpl->mustStop(); }

void Machine::setClocking(Clocking Of) {
  if (!PImpl->Time || PImpl->Mode == Of)
    return;
  const bool Before = PImpl->isClocked();
  PImpl->Mode = Of;
  PImpl->tellTimeObservers();
  if (PImpl->isClocked() == Before)
    return;
  PImpl->Time->reset();
  PImpl->chooseLog();
}

std::optional<uint32_t> Machine::readRasterCsr(unsigned Core, unsigned Csr) {
  return PImpl->Raster.hostRead(Core, Csr);
}

bool Machine::writeRasterCsr(unsigned Core, unsigned Csr, uint32_t Value) {
  return PImpl->Raster.hostWrite(Core, Csr, Value);
}

std::vector<std::span<std::byte>> Machine::memory() const {
  return PImpl->Storage->kept();
}

std::vector<std::byte> Machine::imageData() const {
  std::vector<std::byte> Data;
  for (const Image::Segment &S : PImpl->Program->segments()) {
    if (!S.Writable)
      continue;
    const size_t At = Data.size();
    Data.resize(At + S.MemBytes);
    [[maybe_unused]] const bool Read =
        read(S.Address, std::span(Data).subspan(At));
    assert(Read && "a segment of the loaded image is readable by the host");
  }
  return Data;
}

bool Machine::setImageData(std::span<const std::byte> Data) {
  uint64_t Bytes = 0;
  for (const Image::Segment &S : PImpl->Program->segments())
    Bytes += S.Writable ? S.MemBytes : 0;
  if (Bytes != Data.size())
    return false;
  for (const Image::Segment &S : PImpl->Program->segments()) {
    if (!S.Writable)
      continue;
    [[maybe_unused]] const bool Wrote =
        write(S.Address, Data.first(S.MemBytes));
    assert(Wrote && "a segment of the loaded image is writable by the host");
    Data = Data.subspan(S.MemBytes);
  }
  return true;
}

std::optional<std::vector<std::byte>> Machine::rasterState() const {
  return PImpl->Raster.state();
}

bool Machine::setRasterState(std::span<const std::byte> State) {
  return PImpl->Raster.setState(State);
}

} // namespace vorion::isasim
