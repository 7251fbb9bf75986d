#include "timing/Clock.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace vorion::isasim {

namespace {
/// Records that a core's trace may hold before the others stop waiting for one
/// whose trace is used up: many quanta.
constexpr size_t LongestBacklog = 1 << 20;
/// Fewer than this in all traces are left until the next sync point.
constexpr size_t FewestTaken = 1 << 12;
/// Steps between two looks at whether the time is over: milliseconds.
constexpr unsigned LongestStretch = 1 << 14;

} // namespace

Clock::Clock(const Config &C, const HostBudget &BudgetIn)
    : Shape(C), Budget(BudgetIn), Timing(C.Timing), Name(nameOf(C)),
      Memory(Timing, C.Clusters,
             C.coresPerCluster() + C.SocketsPerCluster + 1 +
                 (HostUnits::exist(Timing) ? 1 : 0)),
      Barriers(C.Barriers) {
  // In a crossbar the instruction cache has the port of its socket's first
  // core. Rasterizers and pixel units come behind all cores, DMA engines last.
  for (unsigned N = 0; N != C.cores(); ++N) {
    std::vector<TraceBuffer *> OfCore;
    for (unsigned W = 0; W != C.WarpsPerCore; ++W) {
      Traces.push_back(std::make_unique<TraceBuffer>());
      Traces.back()->LocalBanks = Timing.Core.LocalBanks;
      Traces.back()->InterleavedStacks = Timing.Core.InterleavedStacks != 0;
      OfCore.push_back(Traces.back().get());
    }
    Cores.emplace_back(Timing.Core,
                       MemoryPort{C.clusterOf(N), N, N % C.coresPerCluster()},
                       OfCore, C.Barriers, Timing.Socket.IcacheKib != 0,
                       MemorySystem::reportsDequeues(Timing));
  }
  for (unsigned N = 0; N != C.sockets(); ++N)
    Rasters.emplace_back(
        Timing,
        MemoryPort{N / C.SocketsPerCluster, placeOfRaster(N),
                   C.coresPerCluster() + N % C.SocketsPerCluster},
        C.CoresPerSocket, C.Raster.QueueDepth,
        HostBudget::FetchBytes / 2 / C.sockets());
  for (unsigned N = 0; N != C.Clusters; ++N)
    Pixels.emplace_back(Timing,
                        MemoryPort{N, placeOfPixels(N),
                                   C.coresPerCluster() + C.SocketsPerCluster},
                        C.coresPerCluster(),
                        HostBudget::FetchBytes / 2 / C.Clusters);
  for (unsigned N = 0; N != C.sockets(); ++N)
    Codes.emplace_back(Timing.Socket,
                       MemoryPort{N / C.SocketsPerCluster, placeOfCode(N),
                                  N % C.SocketsPerCluster * C.CoresPerSocket});
  if (HostUnits::exist(Timing))
    Host.emplace(Timing);
}

Clock::~Clock() = default;

void Clock::expect(raster::CommandWork &&Work) {
  const unsigned Core = Work.Core;
  Rasters[Shape.socketOf(Core)].expect(Core % Shape.CoresPerSocket,
                                       std::move(Work));
}

void Clock::expect(raster::TailWork &&Work) {
  const unsigned Core = Work.Core;
  Pixels[Shape.clusterOf(Core)].expect(Core % Shape.coresPerCluster(),
                                       std::move(Work));
}

void Clock::expectPart(const raster::CommandWork &Of,
                       std::vector<raster::GaussianWork> &&Fetched) {
  Rasters[Shape.socketOf(Of.Core)].expectPart(Of.Core % Shape.CoresPerSocket,
                                              Of, std::move(Fetched));
}

bool Clock::hasRoom(unsigned Core) const {
  return Rasters[Shape.socketOf(Core)].hasRoom();
}

bool Clock::hasRoomForTail(unsigned Core) const {
  return Pixels[Shape.clusterOf(Core)].hasRoom();
}

bool Clock::hasRoom() const {
  const auto HasRoom = [](const auto &Unit) { return Unit.hasRoom(); };
  return std::ranges::all_of(Rasters, HasRoom) &&
         std::ranges::all_of(Pixels, HasRoom);
}

void Clock::setObservers(std::vector<TimeObserver *> Observers) {
  Watch.reset();
  if (!Observers.empty())
    Watch.emplace(std::move(Observers));
  const TimeWatch *const Told = Watch ? &*Watch : nullptr;
  for (unsigned N = 0; N != Cores.size(); ++N)
    Cores[N].watch(Told, N);
  for (unsigned N = 0; N != Rasters.size(); ++N)
    Rasters[N].watch(Told, N);
  for (unsigned N = 0; N != Pixels.size(); ++N)
    Pixels[N].watch(Told, N);
  if (Host)
    Host->watch(Told);
  Memory.watch(Told);
}

void Clock::begin(const CodeTable &Code) {
  Ops = describeProgram(Code, Timing.Core, Shape.LanesPerWarp);
  Begun = Now;
  if (Watch)
    Watch->tell([this](TimeObserver &O) { O.timeBegins(Begun); });
  OutOfOrder = 0;
  WorthTaking = false;
  Memory.begin(Begun);
  for (Arrived &B : Barriers)
    B = {};
  for (const auto &T : Traces)
    T->clear();
  const uint32_t FirstWord = Code.low() % TimingLineBytes / 4;
  for (InstructionCache &C : Codes)
    C.begin(Code.low(), (FirstWord + Code.count()) * 4 / TimingLineBytes + 1);
  for (RasterClock &R : Rasters)
    R.begin(Begun);
  for (PixelClock &U : Pixels)
    U.begin(Begun);
  const uint64_t LaunchedAt = launch();
  for (CoreClock &C : Cores)
    C.begin(Ops, FirstWord, Begun, LaunchedAt);
  Horizon = 0;
  Ended.assign(Cores.size(), false);
  AllTurns.assign(placeOfHost() + (Host ? 1 : 0));
}

uint64_t Clock::copies(const HostCopy &Copy, CommandOrder Order) {
  return Host ? Host->sendCopy(Copy, std::move(Order)) : 0;
}

/// All but cores, which have no run, go on until \p IsDone. What is known of
/// rasterizers' work is all that there is.
template <typename Function> void Clock::goOnWithoutCores(Function IsDone) {
  BetweenRuns = true;
  AllTurns.assign(placeOfHost() + 1);
  Ended.assign(Cores.size(), true);
  lastWork();
  for (unsigned N = placeOfRaster(0); N != AllTurns.size(); ++N)
    update(N);
  for (unsigned Steps = 1; !IsDone() && step(); ++Steps)
    if (Steps % LongestStretch == 0 && Budget.isOver())
      break;
  BetweenRuns = false;
}

/// When the run's launch starts the cores.
uint64_t Clock::launch() {
  if (!Host)
    return Begun;
  Host->begin(Begun);
  if (!LaunchOrder)
    LaunchOrder = {.After = {Host->last()}, .HostAfter = {}};
  Launched = Host->sendLaunch(*std::exchange(LaunchOrder, std::nullopt));
  Horizon = Turn::Never;
  goOnWithoutCores([this] { return Host->launchAt(Launched).has_value(); });
  // It is not known only if the time is over.
  const uint64_t At = std::max(Begun, Host->launchAt(Launched).value_or(Begun));
  Horizon = At;
  goOnWithoutCores([] { return false; });
  for (RasterClock &R : Rasters)
    R.moreWork(At);
  for (PixelClock &U : Pixels)
    U.moreWork();
  return At;
}

void Clock::settle() {
  if (!Host)
    return;
  for (RasterClock &R : Rasters)
    R.begin(Now);
  for (PixelClock &U : Pixels)
    U.begin(Now);
  Host->begin(Now);
  Horizon = Turn::Never;
  goOnWithoutCores([this] { return Host->isIdle(); });
  Now = std::max(Now, Host->present());
  Horizon = Now;
  goOnWithoutCores([] { return false; });
  Memory.idleUntil(Now);
  for (RasterClock &R : Rasters)
    R.end(Now);
  for (PixelClock &U : Pixels)
    U.end(Now);
  Host->end(Now);
}

void Clock::setEnded(unsigned Core, uint32_t Warps) {
  Cores[Core].setEnded(Warps);
  Ended[Core] = std::popcount(Warps) == static_cast<int>(Shape.WarpsPerCore);
}

bool Clock::isOverfull() const {
  const size_t MostBytes = HostBudget::TraceBytes / Cores.size();
  return !hasRoom() ||
         std::ranges::any_of(Cores, [MostBytes](const CoreClock &C) {
           return C.backlog() > LongestBacklog || C.backlogBytes() > MostBytes;
         });
}

/// False if the time is over before all is taken.
bool Clock::takeAll() {
  for (unsigned N = 0; N != AllTurns.size(); ++N)
    update(N);
  for (unsigned Steps = 1; step(); ++Steps)
    if (Steps % LongestStretch == 0 && Budget.isOver())
      return false;
  return true;
}

void Clock::publish() {
  size_t Waiting = 0;
  for (const auto &T : Traces) {
    T->publish();
    Waiting += T->size();
  }
  WorthTaking = Waiting >= FewestTaken;
}

void Clock::take() {
  takeAll();
  WorthTaking = false;
}

void Clock::lastWork() {
  for (RasterClock &R : Rasters)
    R.lastWork();
  for (PixelClock &U : Pixels)
    U.lastWork();
}

std::optional<TimeReport> Clock::end() {
  if (isWorthTaking())
    take();
  publish();
  for (unsigned N = 0; N != Cores.size(); ++N)
    setEnded(N, static_cast<uint32_t>((uint64_t{1} << Shape.WarpsPerCore) - 1));
  lastWork();
  if (!takeAll()) {
    giveUp();
    return std::nullopt;
  }
  const uint64_t End = Memory.endRun(coresQuietAt());
  Horizon = End;
  takeAll();
  Memory.idleUntil(End);
  TimeReport R;
  R.Cycles = End - Begun;
  R.ClockMhz = Timing.ClockMhz;
  R.Machine = Name.Name;
  R.MachineChanges = Name.Changes;
  R.OutOfOrder = OutOfOrder;
  R.Host = Timing.Host;
  for (CoreClock &C : Cores) {
    C.end(End);
    R.Cores.push_back(C.time());
  }
  for (RasterClock &C : Rasters) {
    C.end(End);
    R.Rasters.push_back(C.time());
    R.CommandsLeft += C.commandsLeft();
    R.OutOfOrder += C.outOfTurn();
  }
  for (PixelClock &U : Pixels) {
    U.end(End);
    R.PixelUnits.push_back(U.time());
  }
  if (Host) {
    Host->end(End);
    Host->launchEnded(Launched, End);
    R.CommandProcessors.push_back(Host->processor());
    R.DmaEngines = Host->engines();
  }
  if (Watch)
    Watch->tell([End](TimeObserver &O) { O.timeEnds(End); });
  Memory.report(R, End);
  collectActivities(R);
  Now = End;
  return R;
}

/// What is left of the run is dropped; memory answers what it was asked.
void Clock::giveUp() {
  reset();
  for (CoreClock &C : Cores)
    C.drop();
  while (Memory.nextEvent() != Turn::Never)
    advanceMemory(Memory.nextEvent());
  Now = Memory.endRun(coresQuietAt());
  for (CoreClock &C : Cores)
    C.end(Now);
  for (RasterClock &C : Rasters)
    C.end(Now);
  for (PixelClock &U : Pixels)
    U.end(Now);
  if (Host)
    Host->reset(Now);
  if (Watch)
    Watch->tell([this](TimeObserver &O) { O.timeEnds(Now); });
}

void Clock::reset() {
  for (RasterClock &R : Rasters)
    R.reset();
  for (PixelClock &U : Pixels)
    U.reset();
  if (Host)
    Host->reset(Now);
}

uint64_t Clock::coresQuietAt() const {
  uint64_t Quiet = Begun;
  for (const CoreClock &C : Cores)
    Quiet = std::max(Quiet, C.quietAt());
  return Quiet;
}

/// Whether no core will do anything more in this run.
bool Clock::coresAreDone() const {
  if (BetweenRuns)
    return true;
  for (size_t N = 0; N != Cores.size(); ++N)
    if (!Ended[N] || !Cores[N].isIdle())
      return false;
  return true;
}

void Clock::update(unsigned Who) {
  if (Who == placeOfHost()) {
    AllTurns.set(Who, Host->turn());
    return;
  }
  if (Who >= placeOfPixels(0)) {
    AllTurns.set(Who, Pixels[Who - placeOfPixels(0)].turn());
    return;
  }
  if (Who >= placeOfRaster(0)) {
    RasterClock &R = Rasters[Who - placeOfRaster(0)];
    R.refresh();
    AllTurns.set(Who, R.turn());
    return;
  }
  CoreClock &C = Cores[Who];
  if (C.state() == CoreClock::State::Starved)
    C.advance();
  const Turn OfCore = C.turn();
  AllTurns.set(Who, std::min(OfCore.IsKnown || !Ended[Who] ? OfCore : Turn(),
                             C.frontTurn()));
}

/// The last of those that a barrier counts lets all go on.
void Clock::arrive(unsigned Core, uint64_t Then) {
  CoreClock &C = Cores[Core];
  Arrived &B = Barriers[C.barrier()];
  if (B.Warps.size() + 1 < C.barrierCount()) {
    B.Warps.emplace_back(Core, C.warp());
    C.block();
    return;
  }
  C.resume(Then, CoreCycle::Barrier);
  for (const auto &[Other, Warp] : B.Warps) {
    Cores[Other].select(Warp);
    Cores[Other].resume(Then, CoreCycle::Barrier);
    Cores[Other].advance();
    update(Other);
  }
  B.Warps.clear();
}

/// Asks for the line of code that \p Core needs.
void Clock::fetchCode(unsigned Core, uint64_t Then) {
  CoreClock &C = Cores[Core];
  InstructionCache &Code = Codes[Shape.socketOf(Core)];
  const uint32_t Line = C.wantedLine();
  const auto Known = Code.fetch(Memory, Line, Then, {Core, C.warp()});
  if (Known)
    C.fetched(C.warp(), Line, *Known, Code.keeps(Line));
  else
    C.block();
}

/// Does the request of \p Core at \p Then, or blocks the core.
void Clock::grant(unsigned Core, uint64_t Then) {
  CoreClock &C = Cores[Core];
  RasterClock &R = Rasters[Shape.socketOf(Core)];
  const unsigned Agent = Core % Shape.CoresPerSocket;
  switch (C.state()) {
  case CoreClock::State::Access:
    if (!C.access(Memory))
      return;
    break;
  case CoreClock::State::Barrier:
    arrive(Core, Then);
    break;
  case CoreClock::State::RasterStart:
    if (R.isFull(Agent)) {
      C.block();
      break;
    }
    R.start(Agent, Then);
    update(placeOfRaster(Shape.socketOf(Core)));
    C.resume(Then, CoreCycle::RasterFull);
    break;
  case CoreClock::State::RasterWait:
    if (R.isBusy(Agent)) {
      C.block();
      break;
    }
    C.resume(Then, CoreCycle::RasterWait);
    break;
  case CoreClock::State::RasterTake:
    if (!R.canTake(Agent)) {
      C.block();
      break;
    }
    R.takeBatch(Agent, Then);
    update(placeOfRaster(Shape.socketOf(Core)));
    C.resume(Then, CoreCycle::RasterWait);
    break;
  case CoreClock::State::Fetch:
    fetchCode(Core, Then);
    break;
  case CoreClock::State::Answer:
  case CoreClock::State::Step:
    C.step(Then);
    return;
  case CoreClock::State::LocalBarrier: // its core's affair
  case CoreClock::State::Starved:
    break;
  }
  C.advance();
}

/// Does the next request in the order of time; false if there is none, or if a
/// core might still make an earlier one.
bool Clock::step() {
  unsigned Who = AllTurns.first();
  Turn First = AllTurns[Who];
  const Turn OfMemory(Memory.nextEvent());
  if (!First.IsKnown && First < OfMemory) {
    if (!isOverfull())
      return false;
    ++OutOfOrder;
    const auto Known = [](Turn T) { return T.IsKnown ? T : Turn(); };
    Who = 0;
    for (unsigned N = 1; N != AllTurns.size(); ++N)
      if (Known(AllTurns[N]) < Known(AllTurns[Who]))
        Who = N;
    First = AllTurns[Who];
    // What is not known may wait for what memory answers.
    if (!First.IsKnown)
      return stepMemory(OfMemory);
  }
  // Whoever goes on in a cycle knows all that memory has decided by then.
  if (!(First < OfMemory))
    return stepMemory(First);
  if (!First.IsKnown)
    return false;
  const uint64_t Then = First.At;
  if (Who < Cores.size()) {
    if (Cores[Who].frontTurn().At == Then)
      Cores[Who].beginFront(Memory);
    else
      grant(Who, Then);
    update(Who);
    return true;
  }
  if (coresAreDone() && Then > std::max(Horizon, coresQuietAt()))
    return false;
  if (Who == placeOfHost())
    Host->step(Memory);
  else if (Who < placeOfPixels(0))
    stepRaster(Who - placeOfRaster(0), Then);
  else
    stepPixels(Who - placeOfPixels(0), Then);
  update(Who);
  return true;
}

/// Memory goes on, not beyond \p Next, which is when somebody else does.
bool Clock::stepMemory(Turn Next) {
  uint64_t Until = Next.IsKnown ? Next.At : Next.At - 1;
  if (coresAreDone())
    Until = std::min(Until, std::max(Horizon, coresQuietAt()));
  if (const uint64_t Event = Memory.nextEvent();
      Event == Turn::Never || Event > Until)
    return false;
  advanceMemory(Until);
  return true;
}

void Clock::advanceMemory(uint64_t Until) {
  Answers.clear();
  Memory.advance(Until, Answers);
  for (const Answer &A : Answers) {
    const uint32_t Who = A.To.Unit;
    if (Who & MemorySystem::IsBehindLink) {
      Host->answer(A);
      update(placeOfHost());
      continue;
    }
    if (Who >= placeOfCode(0)) {
      arriveCode(Who - placeOfCode(0), A);
      continue;
    }
    if (Who >= placeOfPixels(0))
      Pixels[Who - placeOfPixels(0)].answer(A);
    else if (Who >= placeOfRaster(0))
      Rasters[Who - placeOfRaster(0)].answer(A);
    else
      Cores[Who].answer(A);
    update(Who);
  }
}

/// A line of code comes for those of \p Socket that wait for it.
void Clock::arriveCode(unsigned Socket, const Answer &A) {
  InstructionCache &Code = Codes[Socket];
  const InstructionCache::Arrived Line = Code.answer(A);
  for (const auto &[Core, Warp] : Line.Who) {
    Cores[Core].fetched(Warp, Line.Line, A.arrival(), Code.keeps(Line.Line));
    Cores[Core].advance();
    update(Core);
  }
}

/// A core that its rasterizer's queue or work had blocked tries again.
void Clock::wake(unsigned Core, uint64_t Then) {
  for (unsigned W = 0; W != Cores[Core].warps(); ++W)
    if (Cores[Core].selectWaiting(W))
      grant(Core, Then);
  update(Core);
}

void Clock::stepRaster(unsigned Socket, uint64_t Then) {
  const auto Done = Rasters[Socket].step(Memory);
  if (!Done)
    return;
  const unsigned Core = Socket * Shape.CoresPerSocket + Done->Agent;
  if (Done->HandedOver) {
    const unsigned Cluster = Shape.clusterOf(Core);
    Pixels[Cluster].accept(Core % Shape.coresPerCluster(), Done->At);
    update(placeOfPixels(Cluster));
  }
  wake(Core, Then);
}

void Clock::stepPixels(unsigned Cluster, uint64_t Then) {
  const auto Local = Pixels[Cluster].step(Memory);
  if (!Local)
    return;
  const unsigned Core = Cluster * Shape.coresPerCluster() + *Local;
  Rasters[Shape.socketOf(Core)].tailDone(Core % Shape.CoresPerSocket);
  wake(Core, Then);
}

} // namespace vorion::isasim
