#include "timing/raster/RasterClock.h"

#include "raster/RasterTables.h"
#include "timing/common/DatapathUnits.h"

#include <algorithm>

namespace vorion::isasim {

using raster::GaussianWork;

namespace {
constexpr unsigned HalfBuffer = raster::VR_MAX_TILE * raster::VR_MAX_TILE / 2;
size_t bytesOf(size_t Gaussians) { return Gaussians * sizeof(GaussianWork); }

/// Of a command that was refused, units may not exist.
size_t expOf(raster::LaneUnits U) {
  return U.Exp < raster::ExpUnitCount ? U.Exp : 0;
}
size_t frontEndOf(raster::LaneUnits U) {
  return U.FrontEnd < std::size(raster::FrontEnds) ? U.FrontEnd : 0;
}
size_t blendOf(raster::LaneUnits U) {
  return U.Blend < raster::BlendUnitCount ? U.Blend : 0;
}
} // namespace

RasterClock::RasterClock(const TimingConfig &Params, MemoryPort Port,
                         unsigned NumAgents, unsigned QueueDepthIn,
                         size_t MostHeldIn)
    : Timing(Params.Raster), QueueDepth(QueueDepthIn), MostHeld(MostHeldIn),
      Agents(NumAgents), Fetch(Port, Timing.BufferEntries), Lanes(Timing),
      Store(Params, Port) {}

void RasterClock::watch(const TimeWatch *Observers, unsigned Own) {
  Watch = Observers;
  Ledger.listen(nullptr);
  if (Watch)
    Ledger.listen([this, Own](RasterCycle What, uint64_t From, uint64_t Until) {
      Watch->tell(
          [&](TimeObserver &O) { O.rasterSpent(Own, What, {From, Until}); });
    });
}

/// What is known of the command of \p Agent that is being executed, which may
/// have been taken.
RasterWork &RasterClock::known(unsigned Agent,
                               const raster::CommandWork &Begun) {
  auto &Expected = Agents[Agent].Expected;
  if (!Expected.empty() && !Expected.back().isComplete())
    return Expected.back();
  const bool IsTaken = Now != Stage::Idle && Now != Stage::Take;
  if (IsTaken && Serving == Agent && !Work.isComplete())
    return Work;
  Held += sizeof(RasterWork);
  return Expected.emplace_back(Begun);
}

void RasterClock::expectPart(unsigned Agent, const raster::CommandWork &Begun,
                             std::vector<GaussianWork> &&Fetched) {
  Held += bytesOf(Fetched.size());
  known(Agent, Begun).add(std::move(Fetched));
}

void RasterClock::expect(unsigned Agent, raster::CommandWork &&Executed) {
  Held += bytesOf(Executed.Gaussians.size());
  RasterWork &To = known(Agent, Executed);
  To.complete(std::move(Executed));
}

void RasterClock::refresh() {
  if (IsStarved && (Work.isComplete() || Number != Work.known()))
    fetched();
}

void RasterClock::begin(uint64_t Start) {
  MoreWork = true;
  OutOfTurn = 0;
  if (Now == Stage::Idle || Now == Stage::Take)
    DispatchAt = std::max(DispatchAt, Start);
  if (Now == Stage::Take)
    At = std::max(At, DispatchAt);
  if (Behind)
    Behind->At = std::max(Behind->At, Start);
  Ledger.begin(Start);
  Spent = {};
  OfLanes = {};
}

void RasterClock::moreWork(uint64_t Start) {
  MoreWork = true;
  if ((Now == Stage::Idle || Now == Stage::Take) && DispatchAt < Start)
    spend(RasterCycle::Idle, Start - DispatchAt);
  if (Now == Stage::Take)
    At = std::max(At, DispatchAt);
}

void RasterClock::reset() {
  for (Agent &A : Agents) {
    A.Expected.clear();
    A.Queued = A.Behind = A.Tails = A.Waiting = 0;
    A.Batches.clear();
  }
  Behind.reset();
  Work = {};
  Held = 0;
  IsStarved = false;
  IsDirty = true;
  Now = Stage::Idle;
  At = Turn::Never;
  Lanes.clear();
  Ledger.clear();
}

uint64_t RasterClock::commandsLeft() const {
  uint64_t Left = 0;
  for (const Agent &A : Agents)
    Left += A.Queued + A.Tails;
  return Left;
}

void RasterClock::start(unsigned Agent, uint64_t Then) {
  ++Agents[Agent].Queued;
  if (Now != Stage::Idle)
    return;
  Now = Stage::Take;
  At = std::max(Then, DispatchAt);
}

void RasterClock::takeBatch(unsigned Agent, uint64_t Then) {
  auto &A = Agents[Agent];
  if (A.Batches.empty())
    return;
  A.Waiting -= A.Batches.front();
  A.Batches.pop_front();
  // It may have been what the rasterizer waits for.
  if (Now == Stage::HandOver && At == Turn::Never && Serving == Agent &&
      A.Waiting < BatchDepth)
    At = std::max(Then, DispatchAt);
}

/// The batch is complete, the lanes are empty and the agent has room.
void RasterClock::handOver() {
  spend(RasterCycle::Drain, At - DispatchAt);
  Agents[Serving].Batches.push_back(true);
  ++Agents[Serving].Waiting;
  HandedOver = Number;
  if (DueBatches > 1) {
    --DueBatches;
    return awaitRoom();
  }
  DueBatches = 0;
  Now = Stage::Fetch;
  fetched();
}

/// The next batch is complete, and waits for its agent.
void RasterClock::awaitRoom() {
  Now = Stage::HandOver;
  At = Agents[Serving].Waiting < BatchDepth ? DispatchAt : Turn::Never;
}

std::optional<RasterClock::Finished> RasterClock::step(MemorySystem &Memory) {
  if (Behind && Turn(Behind->At) < turnOfFront()) {
    if (Behind->Next.Row == Behind->Work.What.Height)
      return finishBehind(Memory);
    writeBehind(Memory);
    return std::nullopt;
  }
  Ledger.settle(At);
  switch (Now) {
  case Stage::Take:
    if (mustWaitForBehind()) {
      At = Turn::Never;
      break;
    }
    take();
    if (!task().Refusal)
      load(Memory);
    fetched();
    break;
  case Stage::Fetch:
    fetch(Memory);
    break;
  case Stage::HandOver:
    handOver();
    return Finished{Serving, false, DispatchAt};
  case Stage::Drain:
    drain(Memory);
    break;
  case Stage::Done:
    return finish(Memory);
  case Stage::Idle:
  case Stage::Full:
    break;
  }
  return std::nullopt;
}

void RasterClock::answer(const Answer &A) {
  if (!Fetch.answer(A))
    return;
  if (Behind && Behind->At == Turn::Never)
    writtenBehind();
  if (Now == Stage::Fetch)
    fetched();
  else if (Now == Stage::Drain && At == Turn::Never)
    drained();
}

/// Round-robin over the agents that have a command by now.
std::optional<unsigned> RasterClock::nextAgent() const {
  std::optional<unsigned> Unknown;
  for (unsigned Tried = 0; Tried != Agents.size(); ++Tried) {
    const auto Turn =
        static_cast<unsigned>((NextAgent + Tried) % Agents.size());
    const Agent &A = Agents[Turn];
    if (!A.hasCommand())
      continue;
    if (!A.Expected.empty() || (MoreWork && hasRoom()))
      return Turn;
    if (MoreWork && !Unknown)
      Unknown = Turn;
  }
  return Unknown;
}

/// Whether a tile, so that the next can be blended while it is written, or a
/// clean buffer for that.
bool RasterClock::fitsBuffer(const raster::Job &J) const {
  return J.bufferPlaces() <= Timing.TileOverlap * HalfBuffer;
}

/// A command that needs the whole buffer, or may read what is being written.
bool RasterClock::mustWaitForBehind() const {
  if (!Behind)
    return false;
  const raster::Job &Next =
      Agents[*nextAgent()].Expected.front().command().What;
  return Next.loadsOutput() || !fitsBuffer(Next);
}

void RasterClock::take() {
  Serving = *nextAgent();
  for (unsigned N = NextAgent; MoreWork && N != Serving;
       N = static_cast<unsigned>((N + 1) % Agents.size()))
    OutOfTurn += Agents[N].hasCommand();
  NextAgent = static_cast<unsigned>((Serving + 1) % Agents.size());
  Agent &A = Agents[Serving];
  Work = std::move(A.Expected.front());
  A.Expected.pop_front();
  Held -= sizeof(RasterWork);
  ++Spent.Commands;

  spend(Behind ? RasterCycle::Drain : RasterCycle::Idle, At - DispatchAt);
  TakenAt = At;
  // What is still written behind has the port first.
  const uint64_t Begun = Behind ? std::max(At + Timing.StartCycles, Fetch.now())
                                : At + Timing.StartCycles;
  const uint64_t Pixels = uint64_t{task().Width} * task().Height;
  OfLanes.Moved += Pixels;
  OfLanes.RangeWords += task().rangeWords() * Pixels;
  BlendsCounted = false;
  if (Work.isComplete())
    countBlends();
  // The whole tile is cleared, a row of banks at a time, unless that was done
  // as the last one of its buffer was written. Its rows begin in rows of banks.
  const unsigned RowsOfBanks =
      task().Height * ((task().Width + Timing.Banks - 1) / Timing.Banks);
  spend(RasterCycle::Begin, Timing.StartCycles + (IsDirty ? RowsOfBanks : 0));
  Fetch.begin(Begun);
  Fetch.beginSet(GaussianFetch::Others);
  Number = Dispatches = HandedOver = 0;
  Fragments = DueBatches = 0;
  BlendedAt = 0;
  Now = Stage::Fetch;
}

void RasterClock::countBlends() {
  const uint64_t Blends = Work.command().Counts.Blends;
  if (task().IsBackward) {
    (task().Units.isConic() ? OfLanes.Gradients : OfLanes.RayGradients) +=
        Blends;
    if (task().Blend.Falloff.IsLowPass)
      OfLanes.SurfelGradients += Blends;
  } else if (task().Units.isOpaque())
    OfLanes.Passed += Blends;
  else
    OfLanes.Blended[blendOf(task().Units)] += Blends;
  BlendsCounted = true;
}

/// What a tile begins with, a line a cycle: of a backward one its pixels'
/// transmittances, gradients and last contributors, of another its pixels if
/// they are loaded, and their ranges.
void RasterClock::load(MemorySystem &Memory) {
  const uint32_t PixelBytes = task().pixelBytes();
  const auto Read = [&](uint32_t First, unsigned Row, uint32_t Bytes) {
    const uint32_t Pitch = task().OutputPitch / PixelBytes * Bytes;
    Fetch.read(Memory, GaussianFetch::Others, First + Row * Pitch,
               task().Width * Bytes);
  };
  for (unsigned Row = 0; Row != task().Height; ++Row) {
    if (task().loadsOutput())
      Read(task().Output, Row, PixelBytes);
    if (task().IsBackward) {
      Read(task().Upstream, Row, PixelBytes);
      Read(task().Last, Row, sizeof(uint32_t));
    }
    if (task().IsLimited)
      Read(task().Limit, Row, sizeof(uint32_t));
    if (task().StartsLate)
      Read(task().From, Row, sizeof(uint32_t));
  }
}

/// The place in its list of a Gaussian in the order of the fetches.
uint32_t RasterClock::entryOf(size_t Gaussian) const {
  return static_cast<uint32_t>(task().IsBackward
                                   ? Work.command().Entries - 1 - Gaussian
                                   : Work.command().First + Gaussian);
}

void RasterClock::fetch(MemorySystem &Memory) {
  constexpr int LineBytes = TimingLineBytes;
  const GaussianWork &G = Work[Number];
  Fetch.waitUntil(At);
  if (!G.Address) {
    Fetch.skipRecord(Number);
  } else {
    const uint64_t EntryAt =
        Fetch.entryAt(Memory, task().List + 4 * entryOf(Number),
                      task().IsBackward ? -LineBytes : LineBytes);
    if (EntryAt > Fetch.now()) {
      At = EntryAt;
      return;
    }
    // Nothing was left to dispatch while its entry was on its way.
    if (Dispatches == Number &&
        Fetch.readyAt(GaussianFetch::Others) <= DispatchAt)
      waitFor(Fetch.now(), Fetch.arrivalOfEntry(), RasterCycle::Fetch);
    Fetch.readRecord(Memory, Number, G.Address, task().frontEnd().RecordBytes,
                     G.SpansTiles);
  }
  ++Number;
  fetched();
}

bool RasterClock::endsBatch(size_t Gaussian) const {
  return task().IsBackward && entryOf(Gaussian) % raster::VR_GRAD_LANES == 0;
}

/// Dispatches what is known to come, in order, and says when there is more to
/// do. Nothing is dispatched before all is there that the tile begins with.
void RasterClock::fetched() {
  const Arrival Loaded = Fetch.arrivalOf(GaussianFetch::Others);
  const bool IsLoaded = Loaded.At != Turn::Never;
  if (IsLoaded)
    waitFor(Loaded.At, Loaded, RasterCycle::Begin);
  for (; IsLoaded && Dispatches != Number && DueBatches == 0; ++Dispatches) {
    const Arrival Record = Fetch.arrivalOfRecord(Dispatches);
    if (Record.At == Turn::Never)
      break;
    waitFor(Record.At + Timing.RecordCycles, Record, RasterCycle::Fetch);
    dispatch(Work[Dispatches]);
    Fetch.hold(Dispatches, DispatchAt + 1); // its entry is free a cycle later
    if (task().HandsFragments)
      countFragments(Work[Dispatches].ChosenPixels);
  }
  Held -= bytesOf(Work.drop(Dispatches));
  if (DueBatches != 0) {
    IsStarved = false;
    return awaitRoom();
  }
  const bool IsLast = Work.isComplete() && Number == Work.known();
  const bool IsBatch = Number != HandedOver && endsBatch(Number - 1);
  IsStarved = !IsLast && !IsBatch && Number == Work.known();
  if (!IsLast && !IsBatch) {
    // The next one needs the entry of whoever had it before.
    At = Fetch.startOf(Number);
    return;
  }
  At = Turn::Never;
  if (!IsLoaded || Dispatches != Number)
    return;
  if (!IsBatch)
    return flush();
  // The gather empties before its sums go.
  spend(
      RasterCycle::Flush,
      backwardDepth(task().Units, static_cast<unsigned>(task().Backward.Unit)));
  awaitRoom();
}

/// Fragments that are handed over leave the lanes while others are dispatched.
void RasterClock::countFragments(unsigned More) {
  Fragments += More;
  DueBatches = Fragments / raster::VR_GRAD_LANES;
  Fragments %= raster::VR_GRAD_LANES;
}

void RasterClock::dispatch(const GaussianWork &G) {
  ++Spent.Gaussians;
  if (G.Width == 0) {
    ++Spent.Clipped;
    spend(RasterCycle::Clip, Timing.ClipCycles);
    return;
  }
  const RasterLanes::Passage P = Lanes.passageOf(G, task().IsBackward);
  OfLanes.BlockRows += P.BlockRows;
  const uint64_t Safe = Lanes.safeAt(G, P.Cycles, DispatchAt);
  if (Safe > DispatchAt)
    spend(RasterCycle::Hazard, Safe - DispatchAt);
  Lanes.enter(G, DispatchAt, P.Cycles);
  Spent.LaneSlots += P.Slots;
  if (!task().Units.isConic())
    OfLanes.Covered[frontEndOf(task().Units)] += P.Slots;
  if (task().Blend.Falloff.IsLowPass)
    OfLanes.LowPassed += P.Slots;
  if (!task().Units.isOpaque())
    OfLanes.Evaluated[expOf(task().Units)] += P.Slots;
  spend(RasterCycle::Blend, std::max<uint64_t>(P.Cycles, Timing.ClipCycles));
  BlendedAt = DispatchAt;
}

/// Dispatch is done: the lanes empty, then the tile is written. A pixel can be
/// read in the cycle in which it gets its last value.
void RasterClock::flush() {
  const uint64_t Emptied = BlendedAt + laneDepth(task().Units) - 1;
  if (BlendedAt != 0 && !task().IsBackward && Emptied > DispatchAt)
    spend(RasterCycle::Flush, Emptied - DispatchAt);
  if (!BlendsCounted)
    countBlends();
  if (Fragments != 0) { // the last batch is not full
    Fragments = 0;
    DueBatches = 1;
    return awaitRoom();
  }
  Lanes.clear();
  Draining = {};
  At = DispatchAt;
  IsDirty = true;
  if (task().Drains || task().handsOver() || Work.command().hasFailed()) {
    Now = Stage::Done;
  } else if (!fitsBuffer(task())) {
    Now = Stage::Drain;
  } else if (Behind) {
    Now = Stage::Full;
    At = Turn::Never;
  } else {
    drainBehind();
  }
}

/// The tile is written, and cleared with that, while the rasterizer goes on.
void RasterClock::drainBehind() {
  IsDirty = false;
  ++Agents[Serving].Behind;
  Behind = Written{Work.take(), Serving, TakenAt, DispatchAt, {}};
  goOn();
}

void RasterClock::drain(MemorySystem &Memory) {
  Fetch.waitUntil(At);
  OfLanes.Moved += TileStore::writeLine(Memory, Fetch, task(), Draining,
                                        GaussianFetch::Others);
  drained();
}

void RasterClock::drained() {
  At = Store.goesOnAt(Fetch, GaussianFetch::Others, DispatchAt + 1, task(),
                      Draining);
  if (At == Turn::Never)
    return;
  // Sending the line is its own cycle, what follows is the link's.
  spend(RasterCycle::Drain, 1);
  waitFor(At, Fetch.arrivalOf(GaussianFetch::Others), RasterCycle::Drain);
  if (Draining.Row == task().Height)
    Now = Stage::Done;
}

void RasterClock::writeBehind(MemorySystem &Memory) {
  Fetch.waitUntil(Behind->At);
  OfLanes.Moved +=
      TileStore::writeLine(Memory, Fetch, Behind->Work.What, Behind->Next,
                           GaussianFetch::EvenOthers);
  writtenBehind();
}

void RasterClock::writtenBehind() {
  Behind->At = Store.goesOnAt(Fetch, GaussianFetch::EvenOthers, Fetch.now(),
                              Behind->Work.What, Behind->Next);
}

/// Whoever waits for the buffer, or has nothing else to do, spent its time on
/// that.
RasterClock::Finished RasterClock::finishBehind(MemorySystem &Memory) {
  const Written Done = std::move(*Behind);
  Behind.reset();
  --Agents[Done.Agent].Behind;
  const uint64_t End = Store.writeRest(Memory, Done.Work, Done.At);
  const bool Waits =
      Now == Stage::Idle ||
      (At == Turn::Never && (Now == Stage::Take || Now == Stage::Full));
  if (Waits && End > DispatchAt)
    spend(RasterCycle::Drain, End - DispatchAt);
  const Finished Ended = complete(Done.Work, Done.Agent, Done.TakenAt, End);
  if (Now == Stage::Full)
    drainBehind();
  else if (Waits && Now == Stage::Take)
    At = DispatchAt;
  return Ended;
}

RasterClock::Finished RasterClock::finish(MemorySystem &Memory) {
  if (task().handsOver())
    Agents[Serving].Batches.push_back(false);
  spend(RasterCycle::Drain,
        Store.writeRest(Memory, Work.command(), DispatchAt) - DispatchAt);
  const Finished Done = complete(Work.command(), Serving, TakenAt, DispatchAt);
  goOn();
  return Done;
}

RasterClock::Finished RasterClock::complete(const raster::CommandWork &Of,
                                            unsigned Agent, uint64_t Taken,
                                            uint64_t Then) {
  if (Watch)
    Watch->tell([&](TimeObserver &O) { O.tile(Of, {Taken, Then}); });
  --Agents[Agent].Queued;
  Agents[Agent].Tails += Of.HandedOver;
  return {Agent, Of.HandedOver, Then};
}

/// To the next command, if there is one.
void RasterClock::goOn() {
  const bool More = std::ranges::any_of(Agents, &Agent::hasCommand);
  Now = More ? Stage::Take : Stage::Idle;
  At = More ? DispatchAt : Turn::Never;
}

void RasterClock::end(uint64_t End) {
  // Between two commands nothing is spent but by the one that comes.
  const bool IsLoaded = Fetch.readyAt(GaussianFetch::Others) != Turn::Never;
  const RasterCycle Rest =
      Now == Stage::Fetch ? IsLoaded ? RasterCycle::Fetch : RasterCycle::Begin
      : Now == Stage::Drain || Now == Stage::HandOver || Behind
          ? RasterCycle::Drain
          : RasterCycle::Idle;
  Spent.Cycles = Ledger.end(End, Rest);
}

} // namespace vorion::isasim
