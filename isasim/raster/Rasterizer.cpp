#include "raster/Rasterizer.h"

#include "raster/BackwardRun.h"
#include "raster/BlockTests.h"
#include "raster/CommandInput.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace vorion::raster {

namespace {

/// One command in the works: checked, executed, written out.
class Execution {
public:
  /// \p To: who wants to know details; nullptr for nobody.
  Execution(RasterAgent &Served, RasterMemory &Global, TileBuffer &Buffer,
            const Datapath &Unit, const WorkLog *To)
      : Agent(Served), Current(Served.front()),
        Work(beginCommand(Served, Global)), Memory(Global), Tile(Buffer),
        Lanes(Unit), KeepsDetails(To != nullptr),
        Tests(To ? To->blockTests() : 0) {}

  /// To be called once.
  CommandWork run();

private:
  uint32_t blend();
  uint32_t blendPushed();
  uint32_t blendList();
  /// \p G has been checked. \p Address: of the record, 0 if it was pushed.
  void blendOne(const Gaussian &G, uint32_t Address, bool Intersects,
                const BlendOptions &Options);
  bool isTail(uint32_t Remaining) const;
  void copyRow(unsigned Row, std::byte *To) const;
  void writePixels() const;
  void writeTail() const;
  void writeCounts() const;

  RasterAgent &Agent;
  const Command &Current;
  CommandWork Work;
  const Job &Task = Work.What;
  RasterMemory &Memory;
  TileBuffer &Tile;
  const Datapath &Lanes;
  bool KeepsDetails;
  BlockTests Tests;
  uint32_t Done = 0; ///< entries of the list
};

void Execution::blendOne(const Gaussian &G, uint32_t Address, bool Intersects,
                         const BlendOptions &Options) {
  const BoxWork Result = blendFunction(Task, Lanes)(G, Options, Tile);
  Work.Counts.Intersecting += Intersects;
  Work.Counts.Clipped += Result.Clipped;
  Work.Counts.Fragments += Result.Fragments;
  Work.Counts.Blends += Result.Blends;
  if (KeepsDetails)
    Work.Gaussians.push_back(
        {Address, Result.X, Result.Y, Result.Width, Result.Height,
         static_cast<uint16_t>(Result.Fragments), Intersects});
  if (Tests.any() && !Result.Clipped) {
    const BlockWork Left = Tests.count(G, Result, Options.MinAlpha, Tile);
    Work.Gaussians.back().Blocks = Left.Blocks;
    Work.Gaussians.back().BlockPixels = Left.Pixels;
  }
}

uint32_t Execution::blendPushed() {
  for (const Gaussian &G : Current.Pushed) {
    if (Tile.Live == 0)
      break;
    ++Work.Counts.Gaussians;
    if (const uint32_t Status = checkGaussian(G))
      return Status;
    blendOne(G, 0, (G.Tag & VR_INTERSECT) != 0, Task.Blend);
  }
  return VR_OK;
}

/// Whether a reason to hand over holds with \p Remaining entries left.
bool Execution::isTail(uint32_t Remaining) const {
  const uint64_t Pixels = uint64_t{Task.Width} * Task.Height;
  const uint64_t Saturated = Pixels - Tile.Live;
  return Remaining <= Task.TailCount ||
         (Task.TailShare != 0 &&
          Saturated * VR_TAIL_WHOLE >= Task.TailShare * Pixels);
}

uint32_t Execution::blendList() {
  BlendOptions Options = Task.Blend;
  const GaussianList List(Task, Memory);
  Fetched Entry;
  for (; Done != Task.Count && Tile.Live != 0; ++Done) {
    if (Task.mayHandOver() && isTail(Task.Count - Done)) {
      Work.HandedOver = true;
      break;
    }
    const uint32_t Status = List.fetch(Done, Entry);
    Work.Counts.Gaussians += Status != VR_UNMAPPED;
    if (Status)
      return Status;
    Options.Entry = Done;
    blendOne(Entry.Record, Entry.Address, Entry.Intersects, Options);
  }
  return VR_OK;
}

uint32_t Execution::blend() {
  if (Task.Refusal)
    return Task.Refusal;
  Tile.reset(Task.X, Task.Y, Task.Width, Task.Height);
  return Task.TakesPushed ? blendPushed() : blendList();
}

void Execution::copyRow(unsigned Row, std::byte *To) const {
  for (unsigned Column = 0; Column != Task.Width; ++Column) {
    const unsigned At = Row * TileBuffer::Stride + Column;
    // T's sign says "saturated", no more.
    const Pixel P{Tile.R[At], Tile.G[At], Tile.B[At], std::fabs(Tile.T[At])};
    std::memcpy(To + Column * sizeof(Pixel), &P, sizeof(Pixel));
  }
}

void Execution::writePixels() const {
  std::vector<Pixel> &Drained = Agent.drainedTile();
  if (Task.Drains)
    Drained.resize(std::size_t{Task.Width} * Task.Height);
  for (unsigned Row = 0; Task.KeepsLast && Row != Task.Height; ++Row)
    std::memcpy(lastRow(Task, Memory, Row),
                Tile.Last + Row * TileBuffer::Stride,
                Task.Width * sizeof(*Tile.Last));
  for (unsigned Row = 0; Row != Task.Height; ++Row)
    copyRow(Row, Task.Drains
                     ? reinterpret_cast<std::byte *>(&Drained[Row * Task.Width])
                     : outputRow(Task, Memory, Row));
}

/// Fills the command's vx_tail.
void Execution::writeTail() const {
  Tail Record{};
  Record.Rest = Current;
  Record.Rest.List += 4 * Done;
  Record.Rest.Count -= Done;
  Record.Core = Work.Core;
  Record.LiveCount = Tile.Live;
  for (unsigned Row = 0; Row != Task.Height; ++Row)
    for (unsigned Column = 0; Column != Task.Width; ++Column)
      if (!std::signbit(Tile.T[Row * TileBuffer::Stride + Column]))
        Record.Live[2 * Row + Column / 32] |= 1U << Column % 32;
  std::memcpy(Memory.range(Task.TailRecord, sizeof(Record)), &Record,
              sizeof(Record));
}

void Execution::writeCounts() const {
  const auto Word = [](uint64_t Count) {
    return static_cast<uint32_t>(std::min<uint64_t>(Count, ~uint32_t{0}));
  };
  const uint32_t Words[] = {Word(Work.Counts.Gaussians),
                            Word(Work.Counts.Fragments)};
  static_assert(sizeof(Words) == CountsBytes);
  std::memcpy(Memory.range(Task.Last, CountsBytes), Words, CountsBytes);
}

CommandWork Execution::run() {
  if (KeepsDetails)
    Work.Pushed = Current.Pushed;
  Work.Status = blend();
  if (!Work.hasFailed()) {
    Work.Saturated = uint32_t{Task.Width} * Task.Height - Tile.Live;
    writePixels();
    if (Task.KeepsCounts)
      writeCounts();
  }
  if (Work.HandedOver)
    writeTail();
  return std::move(Work);
}

} // namespace

Rasterizer::Rasterizer(RasterMemory &Global, std::vector<RasterAgent *> Served)
    : Memory(Global), Agents(std::move(Served)),
      Tile(std::make_unique<TileBuffer>()), Lanes(datapaths().back()),
      BackwardLanes(backwardDatapaths().back()) {}

Rasterizer::~Rasterizer() = default;

bool Rasterizer::canStep() const {
  if (Backward)
    return Agents[Backward->Turn]->hasRoom();
  return std::any_of(Agents.begin(), Agents.end(),
                     [](const RasterAgent *A) { return A->hasCommand(); });
}

/// Executes the command as a whole, so that its work is known when its agent's
/// core goes on; only the hand-over takes its time.
void Rasterizer::startBackward(std::size_t Turn) {
  if (!BackwardTile)
    BackwardTile = std::make_unique<BackwardBuffer>();
  BackwardRun Run(*Agents[Turn], Memory, *BackwardTile, *BackwardLanes,
                  Log != nullptr);
  Backward = Halted{Turn, {}, VR_OK, {}};
  while (auto Batch = Run.next())
    Backward->Batches.push_back(*Batch);
  CommandWork Done = Run.takeWork();
  Backward->Status = Done.Status;
  Backward->Work = Done.Counts;
  if (Log)
    Log->command(std::move(Done));
}

/// Hands a batch over, or ends the command.
void Rasterizer::stepBackward() {
  RasterAgent &Agent = *Agents[Backward->Turn];
  if (!Backward->Batches.empty()) {
    Agent.offer(Backward->Batches.front());
    Backward->Batches.pop_front();
    return;
  }
  Agent.offer({});
  Agent.complete(Backward->Status, Backward->Work);
  Backward.reset();
}

bool Rasterizer::step() {
  if (!canStep())
    return false;
  const DefaultFloatEnvironment Environment;
  if (Backward) {
    stepBackward();
    return true;
  }
  for (std::size_t Tried = 0; Tried != Agents.size(); ++Tried) {
    const std::size_t Turn = Next;
    RasterAgent &Agent = *Agents[Turn];
    Next = (Next + 1) % Agents.size();
    if (!Agent.hasCommand())
      continue;
    if (Agent.front().isBackward()) {
      startBackward(Turn);
      stepBackward();
      return true;
    }
    CommandWork Done = Execution(Agent, Memory, *Tile, *Lanes, Log).run();
    if (Done.HandedOver) {
      HandOvers.push_back({&Agent, Done.What.TailRecord});
      Agent.handOver(Done.Counts);
    } else {
      Agent.complete(Done.Status, Done.Counts);
    }
    if (Log)
      Log->command(std::move(Done));
    return true;
  }
  return false;
}

std::vector<HandOver> Rasterizer::takeHandOvers() {
  return std::exchange(HandOvers, {});
}

void Rasterizer::makeRoom(const RasterAgent &Agent) {
  while (!Agent.canStart() && step()) {
  }
}

void Rasterizer::finish(const RasterAgent &Agent) {
  while (Agent.hasCommand() && step()) {
  }
}

} // namespace vorion::raster
