#include "raster/Rasterizer.h"

#include <algorithm>
#include <utility>

namespace vorion::raster {

Rasterizer::Rasterizer(RasterMemory &Global, std::vector<RasterAgent *> Served)
    : Memory(Global), Agents(std::move(Served)),
      Tile(std::make_unique<TileBuffer>()), Lanes(datapaths().back()),
      BackwardLanes(backwardDatapaths().back()) {}

Rasterizer::~Rasterizer() = default;

bool Rasterizer::canStep() const {
  if (Handing)
    return Agents[Handing->Turn]->hasRoom();
  return Blending ||
         std::any_of(Agents.begin(), Agents.end(),
                     [](const RasterAgent *A) { return A->hasCommand(); });
}

bool Rasterizer::hasRoomInLog() const {
  return !Log || Log->hasRoom(Agents.front()->core());
}

/// For the oldest command of \p Agent, unless it is one that blends.
std::unique_ptr<BatchRun> Rasterizer::makeBatchRun(const RasterAgent &Agent) {
  const Command &C = Agent.front();
  if (C.isBackward()) {
    if (!BackwardTile)
      BackwardTile = std::make_unique<BackwardBuffer>();
    return std::make_unique<BackwardRun>(Agent, Memory, *BackwardTile,
                                         *BackwardLanes, Log);
  }
  const LaneUnits Units{.FrontEnd = frontEndRowOf(ModePrimitive.get(C.Mode))};
  if (!Units.isOpaque() && !C.handsOver())
    return nullptr;
  if (!SurfaceTile)
    SurfaceTile = std::make_unique<SurfaceBuffer>();
  return makeSurfaceRun(Agent, Memory, *SurfaceTile, Log);
}

/// Computes the batch that waits for room, as the machine's rasterizer does: so
/// the clock knows of it before the core takes the one in front.
void Rasterizer::compute() {
  BatchRun &Run = *Handing->Run;
  if (!Run.isDone())
    Handing->Next = Run.next();
  if (Run.isDone()) {
    CommandWork Done = Run.takeWork();
    Handing->IsComputed = true;
    Handing->Status = Done.Status;
    Handing->Counts = Done.Counts;
    if (Log)
      Log->command(std::move(Done));
  } else if (Log && Log->wantsFetches()) {
    Log->part(Run.begun(), Run.takeFetched());
  }
}

/// Hands a batch over, goes on, or ends the command.
void Rasterizer::stepHanding() {
  RasterAgent &Agent = *Agents[Handing->Turn];
  if (Handing->Next) {
    Agent.offer(*std::exchange(Handing->Next, std::nullopt));
  } else if (Handing->IsComputed) {
    if (Agent.front().handsOver())
      Agent.offer({});
    Agent.complete(Handing->Status, Handing->Counts);
    Handing.reset();
    return;
  }
  if (!Handing->IsComputed)
    compute();
}

void Rasterizer::stepBlending() {
  RasterAgent &Agent = *Agents[Blending->Turn];
  TileRun &Run = Blending->Run;
  if (!Run.goOn()) {
    if (Log && Log->wantsFetches())
      Log->part(Run.begun(), Run.takeFetched());
    return;
  }
  CommandWork Done = Run.takeWork();
  Blending.reset();
  if (Done.HandedOver) {
    HandOvers.push_back(
        {&Agent, Done.What.TailRecord, Done.What.hasTailRange()});
    Agent.handOver(Done.Counts);
  } else {
    Agent.complete(Done.Status, Done.Counts);
  }
  if (Log)
    Log->command(std::move(Done));
}

bool Rasterizer::step() {
  if (!canStep())
    return false;
  const DefaultFloatEnvironment Environment;
  if (!Handing && !Blending) {
    while (!Agents[Next]->hasCommand())
      Next = (Next + 1) % Agents.size();
    const std::size_t Turn = Next;
    Next = (Next + 1) % Agents.size();
    if (auto Run = makeBatchRun(*Agents[Turn])) {
      Handing.emplace(Turn, std::move(Run));
      compute();
    } else {
      Blending.emplace(Turn, *Agents[Turn], Memory, *Tile, *Lanes, Log);
    }
  }
  if (Handing)
    stepHanding();
  else
    stepBlending();
  return true;
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
