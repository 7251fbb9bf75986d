#include "timing/RasterClock.h"

#include "raster/RasterTables.h"
#include "timing/DatapathUnits.h"

#include <algorithm>
#include <numeric>

namespace vorion::isasim {

using raster::GaussianWork;

namespace {
constexpr unsigned TableSide = raster::VR_MAX_TILE + 1;
constexpr uint32_t PixelBytes = sizeof(raster::Pixel);

/// Of a command that was refused, units may not exist.
size_t expOf(raster::LaneUnits U) {
  return U.Exp < raster::ExpUnitCount ? U.Exp : 0;
}
size_t blendOf(raster::LaneUnits U) {
  return U.Blend < raster::BlendUnitCount ? U.Blend : 0;
}

RasterTiming inPairs(RasterTiming P) {
  P.Lanes = std::max(1U, P.Lanes / 2);
  return P;
}
} // namespace

DispatchTable::DispatchTable(const RasterTiming &Params)
    : Timing(Params), Known(size_t{TableSide} * TableSide) {}

unsigned DispatchTable::cycles(unsigned Width, unsigned Height) {
  uint16_t &Cycles = Known[Width * TableSide + Height];
  if (Cycles == 0)
    Cycles = static_cast<uint16_t>(count(Width, Height));
  return Cycles;
}

/// A box's place does not matter: it moves all its banks by the same number.
unsigned DispatchTable::count(unsigned Width, unsigned Height) const {
  unsigned Cycles = 1, Used = 0;
  uint64_t Banks = 0;
  for (unsigned Y = 0; Y != Height; ++Y)
    for (unsigned X = 0; X != Width; ++X) {
      const uint64_t Bank = uint64_t{1}
                            << ((X + Timing.Stagger * Y) % Timing.Banks);
      if (Used == Timing.Lanes || (Banks & Bank)) {
        ++Cycles;
        Used = 0;
        Banks = 0;
      }
      ++Used;
      Banks |= Bank;
    }
  return Cycles;
}

RasterClock::RasterClock(const TimingConfig &Params, MemoryPort PortIn,
                         unsigned NumAgents, unsigned QueueDepthIn)
    : Timing(Params.Raster), WriteCycles(MemorySystem::writeCycles(Params)),
      Port(PortIn), QueueDepth(QueueDepthIn), Table(Timing),
      PairTable(inPairs(Timing)), Agents(NumAgents),
      Fetch(Port, Timing.BufferEntries) {}

void RasterClock::watch(const TimeWatch *Observers, unsigned Own) {
  Watch = Observers;
  Ledger.listen(nullptr);
  if (Watch)
    Ledger.listen([this, Own](RasterCycle What, uint64_t From, uint64_t Until) {
      Watch->tell(
          [&](TimeObserver &O) { O.rasterSpent(Own, What, {From, Until}); });
    });
}

void RasterClock::begin(uint64_t Start) {
  MoreWork = true;
  if (Now == Stage::Idle || Now == Stage::Take)
    DispatchAt = std::max(DispatchAt, Start);
  if (Now == Stage::Take)
    At = std::max(At, DispatchAt);
  Ledger.begin(Start);
  Spent = {};
  OfLanes = {};
}

void RasterClock::reset() {
  for (Agent &A : Agents) {
    A.Expected.clear();
    A.Queued = A.Tails = A.Waiting = 0;
    A.Batches.clear();
  }
  Now = Stage::Idle;
  At = Turn::Never;
  InLanes = {};
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
  if (Number == Work.Gaussians.size())
    return flush();
  Now = Stage::Fetch;
  At = Fetch.startOf(Number);
}

std::optional<RasterClock::Finished> RasterClock::step(MemorySystem &Memory) {
  Ledger.settle(At);
  switch (Now) {
  case Stage::Take:
    take();
    if (Work.What.IsBackward && !Work.hasFailed())
      load(Memory);
    fetched();
    break;
  case Stage::Fetch:
    fetch(Memory);
    break;
  case Stage::HandOver:
    handOver();
    return Finished{Serving, false};
  case Stage::Drain:
    drain(Memory);
    break;
  case Stage::Done:
    return finish(Memory);
  case Stage::Idle:
    break;
  }
  return std::nullopt;
}

void RasterClock::answer(uint32_t Tag, uint64_t Then) {
  if (!Fetch.answer(Tag, Then))
    return;
  if (Now == Stage::Fetch)
    fetched();
  else if (Now == Stage::Drain && At == Turn::Never)
    drained();
}

/// Round-robin over the agents that have a command by now.
std::optional<unsigned> RasterClock::nextAgent() const {
  for (unsigned Tried = 0; Tried != Agents.size(); ++Tried) {
    const auto Turn =
        static_cast<unsigned>((NextAgent + Tried) % Agents.size());
    const Agent &A = Agents[Turn];
    if (A.Queued != 0 && (MoreWork || !A.Expected.empty()))
      return Turn;
  }
  return std::nullopt;
}

void RasterClock::take() {
  Serving = *nextAgent();
  NextAgent = static_cast<unsigned>((Serving + 1) % Agents.size());
  Agent &A = Agents[Serving];
  Work = std::move(A.Expected.front());
  A.Expected.pop_front();
  ++Spent.Commands;
  // Of a backward command that failed only the end is known.
  if (Work.What.IsBackward && Work.hasFailed())
    Work.Gaussians.clear();

  spend(RasterCycle::Idle, At - DispatchAt);
  TakenAt = At;
  const uint64_t Begun = At + Timing.StartCycles;
  // The whole tile is cleared, a row of banks at a time.
  const unsigned Pixels = unsigned{Work.What.Width} * Work.What.Height;
  OfLanes.Moved += Pixels;
  if (Work.What.IsBackward)
    OfLanes.Gradients += Work.Counts.Blends;
  else
    OfLanes.Blended[blendOf(Work.What.Units)] += Work.Counts.Blends;
  spend(RasterCycle::Begin,
        Timing.StartCycles + (Pixels + Timing.Banks - 1) / Timing.Banks);
  Fetch.begin(Begun);
  Fetch.beginSet(GaussianFetch::Others);
  Number = Dispatches = 0;
  Now = Stage::Fetch;
}

/// A backward tile begins with its pixels' transmittances, gradients and last
/// contributors, a line a cycle.
void RasterClock::load(MemorySystem &Memory) {
  const auto Read = [&](uint32_t First, unsigned Row, uint32_t Bytes) {
    const uint32_t Pitch = Work.What.OutputPitch / PixelBytes * Bytes;
    Fetch.read(Memory, GaussianFetch::Others, First + Row * Pitch,
               Work.What.Width * Bytes);
  };
  for (unsigned Row = 0; Row != Work.What.Height; ++Row) {
    Read(Work.What.Output, Row, PixelBytes);
    Read(Work.What.Upstream, Row, PixelBytes);
    Read(Work.What.Last, Row, sizeof(uint32_t));
  }
}

/// The place in its list of a Gaussian in the order of the fetches.
uint32_t RasterClock::entryOf(size_t Gaussian) const {
  return static_cast<uint32_t>(
      Work.What.IsBackward ? Work.Gaussians.size() - 1 - Gaussian : Gaussian);
}

void RasterClock::fetch(MemorySystem &Memory) {
  constexpr int LineBytes = TimingLineBytes;
  const GaussianWork &G = Work.Gaussians[Number];
  Fetch.waitUntil(At);
  if (!G.Address) {
    Fetch.skipRecord(Number);
  } else {
    const uint64_t EntryAt =
        Fetch.entryAt(Memory, Work.What.List + 4 * entryOf(Number),
                      Work.What.IsBackward ? -LineBytes : LineBytes);
    if (EntryAt > Fetch.now()) {
      At = EntryAt;
      return;
    }
    Fetch.readRecord(Memory, Number, G.Address, G.SpansTiles);
  }
  ++Number;
  fetched();
}

bool RasterClock::endsBatch(size_t Gaussian) const {
  return Work.What.IsBackward && entryOf(Gaussian) % raster::VR_GRAD_LANES == 0;
}

/// Dispatches what is known to come, in order, and says when there is more to
/// do. Nothing is dispatched before all is there that the tile begins with.
void RasterClock::fetched() {
  const uint64_t Loaded = Fetch.readyAt(GaussianFetch::Others);
  const bool IsLoaded = Loaded != Turn::Never;
  if (IsLoaded && Loaded > DispatchAt)
    spend(RasterCycle::Begin, Loaded - DispatchAt);
  for (; IsLoaded && Dispatches != Number; ++Dispatches) {
    const uint64_t Ready = Fetch.recordAt(Dispatches);
    if (Ready == Turn::Never)
      break;
    dispatch(Work.Gaussians[Dispatches], Ready);
    Fetch.hold(Dispatches, DispatchAt);
  }
  const bool IsLast = Number == Work.Gaussians.size();
  const bool IsBatch = Number != 0 && endsBatch(Number - 1);
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
  spend(RasterCycle::Flush,
        backwardDepth(Work.What.Units,
                      static_cast<unsigned>(Work.What.Backward.Unit)));
  Now = Stage::HandOver;
  if (Agents[Serving].Waiting < BatchDepth)
    At = DispatchAt;
}

void RasterClock::dispatch(const GaussianWork &G, uint64_t Ready) {
  ++Spent.Gaussians;
  if (Ready > DispatchAt)
    spend(RasterCycle::Fetch, Ready - DispatchAt);
  if (G.Width == 0) {
    ++Spent.Clipped;
    spend(RasterCycle::Clip, Timing.ClipCycles);
    return;
  }
  const unsigned Lanes = Work.What.IsBackward ? Timing.Lanes / 2 : Timing.Lanes;
  unsigned Cycles =
      (Work.What.IsBackward ? PairTable : Table).cycles(G.Width, G.Height);
  // Where saturated pixels get no slot (an option), only the others are packed.
  if (G.Slots < unsigned{G.Width} * G.Height)
    Cycles = std::min(Cycles, std::max(1U, (G.Slots + Lanes - 1) / Lanes));
  const uint64_t Safe = safeAt(G, Cycles);
  if (Safe > DispatchAt)
    spend(RasterCycle::Hazard, Safe - DispatchAt);
  InLanes[NextInLanes] = {G, DispatchAt, Cycles};
  NextInLanes = (NextInLanes + 1) % Recent;
  Spent.LaneSlots += G.Slots;
  OfLanes.Evaluated[expOf(Work.What.Units)] += G.Slots;
  spend(RasterCycle::Blend, std::max<uint64_t>(Cycles, Timing.ClipCycles));
}

/// The earliest start at which every pixel that is still being updated has its
/// new value when it is read again. Within a box pixels go out at a steady pace
/// in row order, so that the corners of what two boxes share decide.
uint64_t RasterClock::safeAt(const GaussianWork &G, unsigned Cycles) const {
  uint64_t Safe = DispatchAt;
  const auto When = [](const GaussianWork &B, unsigned Pace, unsigned X,
                       unsigned Y) {
    return static_cast<int64_t>(((Y - B.Y) * B.Width + (X - B.X)) * Pace /
                                (unsigned{B.Width} * B.Height));
  };
  for (const Dispatched &D : InLanes) {
    if (D.Cycles == 0 || D.Start + D.Cycles + Timing.UpdateCycles <= DispatchAt)
      continue;
    const GaussianWork &B = D.What;
    const unsigned X0 = std::max(B.X, G.X), Y0 = std::max(B.Y, G.Y);
    const unsigned X1 = std::min(B.X + B.Width, G.X + G.Width);
    const unsigned Y1 = std::min(B.Y + B.Height, G.Y + G.Height);
    if (X0 >= X1 || Y0 >= Y1)
      continue;
    for (const unsigned X : {X0, X1 - 1})
      for (const unsigned Y : {Y0, Y1 - 1}) {
        const int64_t Start = static_cast<int64_t>(D.Start) +
                              When(B, D.Cycles, X, Y) + Timing.UpdateCycles -
                              When(G, Cycles, X, Y);
        Safe =
            std::max(Safe, static_cast<uint64_t>(std::max<int64_t>(Start, 0)));
      }
  }
  return Safe;
}

/// Dispatch is done: the lanes empty, then the tile is written.
void RasterClock::flush() {
  if (!Work.Gaussians.empty() && !Work.What.IsBackward)
    spend(RasterCycle::Flush, laneDepth(Work.What.Units));
  InLanes = {};
  DrainRow = 0;
  DrainByte = 0;
  At = DispatchAt;
  Now = Work.What.Drains || Work.What.IsBackward || Work.hasFailed()
            ? Stage::Done
            : Stage::Drain;
}

/// A line of the tile.
void RasterClock::drain(MemorySystem &Memory) {
  const uint32_t RowBytes = Work.What.Width * PixelBytes;
  const uint32_t Address =
      Work.What.Output + DrainRow * Work.What.OutputPitch + DrainByte;
  const uint32_t Line = lineOf(Address);
  const uint32_t Bytes =
      std::min(Line + TimingLineBytes - Address, RowBytes - DrainByte);
  Fetch.waitUntil(At);
  Fetch.beginSet(GaussianFetch::Others);
  Fetch.line(Memory, GaussianFetch::Others, Line,
             Bytes == TimingLineBytes ? CacheOp::WriteWhole : CacheOp::Write);
  OfLanes.Moved += Bytes / PixelBytes;
  DrainByte += Bytes;
  if (DrainByte == RowBytes) {
    DrainByte = 0;
    ++DrainRow;
  }
  drained();
}

/// Goes on if the slice has taken the last line: it takes one a cycle, or holds
/// the rasterizer up.
void RasterClock::drained() {
  At = Turn::Never;
  const uint64_t Taken = Fetch.readyAt(GaussianFetch::Others);
  if (Taken == Turn::Never)
    return;
  const uint64_t Next =
      std::max(DispatchAt + 1, Taken > WriteCycles ? Taken - WriteCycles : 0);
  spend(RasterCycle::Drain, Next - DispatchAt);
  At = Next;
  if (DrainRow == Work.What.Height)
    Now = Stage::Done;
}

/// Rows of last contributors, a line a cycle.
void RasterClock::storeLast(MemorySystem &Memory) {
  for (unsigned Row = 0; Row != Work.What.Height; ++Row) {
    const uint32_t First = Work.What.Last + Row * (Work.What.OutputPitch / 4);
    const uint32_t End = First + Work.What.Width * 4;
    for (uint32_t Line = lineOf(First); Line < End; Line += TimingLineBytes) {
      Memory.access(Port.Cluster,
                    {.Now = DispatchAt, .Address = Line, .Op = CacheOp::Write});
      spend(RasterCycle::Drain, 1);
    }
  }
}

RasterClock::Finished RasterClock::finish(MemorySystem &Memory) {
  if (Work.What.IsBackward)
    Agents[Serving].Batches.push_back(false);
  else if (Work.What.KeepsLast && !Work.hasFailed())
    storeLast(Memory);
  if (Work.HandedOver) {
    constexpr unsigned Lines =
        (sizeof(raster::Tail) + TimingLineBytes - 1) / TimingLineBytes;
    for (unsigned N = 0; N != Lines; ++N)
      Memory.access(Port.Cluster,
                    {.Now = DispatchAt + N,
                     .Address = Work.What.TailRecord + N * TimingLineBytes,
                     .Op = CacheOp::Write});
    spend(RasterCycle::Drain, Lines);
  }
  if (Watch)
    Watch->tell(
        [this](TimeObserver &O) { O.tile(Work, {TakenAt, DispatchAt}); });
  --Agents[Serving].Queued;
  Agents[Serving].Tails += Work.HandedOver;
  const bool More = std::any_of(Agents.begin(), Agents.end(),
                                [](const Agent &A) { return A.Queued != 0; });
  Now = More ? Stage::Take : Stage::Idle;
  At = More ? DispatchAt : Turn::Never;
  return {Serving, Work.HandedOver};
}

RasterClock::LaneWork &
RasterClock::LaneWork::operator+=(const LaneWork &Other) {
  for (size_t N = 0; N != Evaluated.size(); ++N)
    Evaluated[N] += Other.Evaluated[N];
  for (size_t N = 0; N != Blended.size(); ++N)
    Blended[N] += Other.Blended[N];
  Gradients += Other.Gradients;
  Moved += Other.Moved;
  return *this;
}

uint64_t RasterClock::LaneWork::allBlended() const {
  return std::accumulate(Blended.begin(), Blended.end(), uint64_t{0});
}

void RasterClock::end(uint64_t End) {
  // Between two commands nothing is spent but by the one that comes.
  const bool IsLoaded = Fetch.readyAt(GaussianFetch::Others) != Turn::Never;
  const RasterCycle Rest =
      Now == Stage::Fetch ? IsLoaded ? RasterCycle::Fetch : RasterCycle::Begin
      : Now == Stage::Drain || Now == Stage::HandOver ? RasterCycle::Drain
                                                      : RasterCycle::Idle;
  Spent.Cycles = Ledger.end(End, Rest);
}

} // namespace vorion::isasim
