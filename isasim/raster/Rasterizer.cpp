#include "raster/Rasterizer.h"

#include "raster/BackwardRun.h"
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
  Execution(const Command &Configured, RasterMemory &Global, TileBuffer &Buffer,
            const Datapath &Unit)
      : C(Configured), Memory(Global), Tile(Buffer), Lanes(Unit),
        Width(TileShapeWidth.get(C.TileShape)),
        Height(TileShapeHeight.get(C.TileShape)),
        Drains(ModeDrain.get(C.Mode) != 0), Takes(ModePushed.get(C.Mode) != 0),
        KeepsLast(ModeKeepLast.get(C.Mode) != 0) {}

  /// Returns a status code; \p Drained gets the pixels of a draining command.
  std::uint32_t run(std::vector<Pixel> &Drained);

  /// Whether run() ended because the pixel unit has to go on.
  bool handsOver() const { return HandedOver; }
  /// Fills the command's vx_tail, for core \p Core.
  void writeTail(unsigned Core);

  const Counters &work() const { return Work; }

  /// Keeps the details of the work too.
  void keepWork() { Keeps = true; }
  CommandWork takeWork(std::uint32_t Status);

private:
  std::uint32_t blendPushed();
  std::uint32_t blendList();
  /// \p G has been checked. \p Address: of the record, 0 if it was pushed.
  void blendOne(const Gaussian &G, std::uint32_t Address, bool Intersects,
                const BlendOptions &Options);
  bool isTail(std::uint32_t Remaining) const;
  void copyRow(unsigned Row, std::byte *To) const;

  const Command &C;
  RasterMemory &Memory;
  TileBuffer &Tile;
  const Datapath &Lanes;
  unsigned Width;
  unsigned Height;
  bool Drains;
  bool Takes; ///< pushed descriptors instead of a list
  bool KeepsLast;
  bool HandedOver = false;
  std::uint32_t Done = 0; ///< entries of the list
  Counters Work;
  bool Keeps = false;
  std::vector<GaussianWork> Kept;
};

void Execution::blendOne(const Gaussian &G, std::uint32_t Address,
                         bool Intersects, const BlendOptions &Options) {
  const BoxWork Result = blendFunction(C, Lanes)(G, Options, Tile);
  Work.Intersecting += Intersects;
  Work.Clipped += Result.Clipped;
  Work.Fragments += Result.Fragments;
  Work.Blends += Result.Blends;
  if (Keeps)
    Kept.push_back({Address, Result.X, Result.Y, Result.Width, Result.Height,
                    static_cast<std::uint16_t>(Result.Fragments), Intersects});
}

std::uint32_t Execution::blendPushed() {
  const BlendOptions Options = blendOptions(C);
  for (const Gaussian &G : C.Pushed) {
    if (Tile.Live == 0)
      break;
    ++Work.Gaussians;
    if (const std::uint32_t Status = checkGaussian(G))
      return Status;
    blendOne(G, 0, (G.Tag & VR_INTERSECT) != 0, Options);
  }
  return VR_OK;
}

/// Whether a reason to hand over holds with \p Remaining entries left.
bool Execution::isTail(std::uint32_t Remaining) const {
  const std::uint64_t Pixels = std::uint64_t{Width} * Height;
  const std::uint64_t Saturated = Pixels - Tile.Live;
  return Remaining <= C.TailCount ||
         (C.TailShare != 0 &&
          Saturated * VR_TAIL_WHOLE >= C.TailShare * Pixels);
}

std::uint32_t Execution::blendList() {
  BlendOptions Options = blendOptions(C);
  Options.KeepLast = KeepsLast;
  const GaussianList List(C, Memory);
  Fetched Entry;
  for (; Done != C.Count && Tile.Live != 0; ++Done) {
    if (C.mayHandOver() && isTail(C.Count - Done)) {
      HandedOver = true;
      break;
    }
    const std::uint32_t Status = List.fetch(Done, Entry);
    Work.Gaussians += Status != VR_UNMAPPED;
    if (Status)
      return Status;
    Options.Entry = Done;
    blendOne(Entry.Record, Entry.Address, Entry.Intersects, Options);
  }
  return VR_OK;
}

void Execution::copyRow(unsigned Row, std::byte *To) const {
  for (unsigned Column = 0; Column != Width; ++Column) {
    const unsigned At = Row * TileBuffer::Stride + Column;
    // T's sign says "saturated", no more.
    const Pixel P{Tile.R[At], Tile.G[At], Tile.B[At], std::fabs(Tile.T[At])};
    std::memcpy(To + Column * sizeof(Pixel), &P, sizeof(Pixel));
  }
}

CommandWork Execution::takeWork(std::uint32_t Status) {
  return {Takes ? 0 : C.List,
          C.Output,
          C.OutputPitch,
          static_cast<std::uint16_t>(Width),
          static_cast<std::uint16_t>(Height),
          laneUnits(C),
          Drains,
          Status != VR_OK,
          std::move(Kept),
          Status == VR_OK && HandedOver ? C.TailRecord : 0,
          KeepsLast ? C.Last : 0};
}

void Execution::writeTail(unsigned Core) {
  Tail Record{};
  Record.List = C.List + 4 * Done;
  Record.Count = C.Count - Done;
  Record.Gaussians = C.Gaussians;
  Record.Options = C.Options;
  Record.Cutoff = C.Cutoff;
  Record.TileOrigin = C.TileOrigin;
  Record.TileShape = C.TileShape;
  Record.Ztile = C.Ztile;
  Record.Output = C.Output;
  Record.OutputPitch = C.OutputPitch;
  Record.Core = Core;
  Record.LiveCount = Tile.Live;
  for (unsigned Row = 0; Row != Height; ++Row)
    for (unsigned Column = 0; Column != Width; ++Column)
      if (!std::signbit(Tile.T[Row * TileBuffer::Stride + Column]))
        Record.Live[2 * Row + Column / 32] |= 1U << Column % 32;
  std::memcpy(Memory.range(C.TailRecord, sizeof(Record)), &Record,
              sizeof(Record));
}

std::uint32_t Execution::run(std::vector<Pixel> &Drained) {
  Work.Commands = 1;
  if (const std::uint32_t Status = checkCommand(C, Memory))
    return Status;
  Tile.reset(TileOriginX.get(C.TileOrigin), TileOriginY.get(C.TileOrigin),
             Width, Height);
  if (const std::uint32_t Status = Takes ? blendPushed() : blendList())
    return Status;
  if (Drains)
    Drained.resize(std::size_t{Width} * Height);
  for (unsigned Row = 0; KeepsLast && Row != Height; ++Row)
    std::memcpy(lastRow(C, Memory, Row), Tile.Last + Row * TileBuffer::Stride,
                Width * sizeof(*Tile.Last));
  for (unsigned Row = 0; Row != Height; ++Row)
    copyRow(Row, Drains ? reinterpret_cast<std::byte *>(&Drained[Row * Width])
                        : outputRow(C, Memory, Row));
  return VR_OK;
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
  BackwardRun Run(Agents[Turn]->front(), Memory, *BackwardTile, *BackwardLanes,
                  Log != nullptr);
  Backward = Halted{Turn, {}, VR_OK, {}};
  while (auto Batch = Run.next())
    Backward->Batches.push_back(*Batch);
  Backward->Status = Run.status();
  Backward->Work = Run.work();
  if (Log)
    Log->command(static_cast<unsigned>(Turn), Run.takeWork());
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
    Execution Work(Agent.front(), Memory, *Tile, *Lanes);
    if (Log)
      Work.keepWork();
    const std::uint32_t Status = Work.run(Agent.drainedTile());
    if (Log)
      Log->command(static_cast<unsigned>(Turn), Work.takeWork(Status));
    if (Status == VR_OK && Work.handsOver()) {
      Work.writeTail(Agent.core());
      HandOvers.push_back({&Agent, Agent.front().TailRecord});
      Agent.handOver(Work.work());
    } else {
      Agent.complete(Status, Work.work());
    }
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
