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
  if (Backward)
    return Agents[Backward->Turn]->hasRoom();
  return Blending ||
         std::any_of(Agents.begin(), Agents.end(),
                     [](const RasterAgent *A) { return A->hasCommand(); });
}

bool Rasterizer::hasRoomInLog() const {
  return !Log || Log->hasRoom(Agents.front()->core());
}

void Rasterizer::startBackward(std::size_t Turn) {
  if (!BackwardTile)
    BackwardTile = std::make_unique<BackwardBuffer>();
  Backward.emplace(Turn, *Agents[Turn], Memory, *BackwardTile, *BackwardLanes,
                   Log);
  nextBatch();
}

/// Computes the batch that waits for room, as the machine's rasterizer does: so
/// the clock knows of it before the core takes the one in front.
void Rasterizer::nextBatch() {
  BackwardRun &Run = Backward->Run;
  Backward->Next = Run.next();
  if (Run.isDone()) {
    CommandWork Done = Run.takeWork();
    Backward->Status = Done.Status;
    Backward->Counts = Done.Counts;
    if (Log)
      Log->command(std::move(Done));
  } else if (Log && Log->wantsFetches()) {
    Log->part(Run.begun(), Run.takeFetched());
  }
}

/// Hands a batch over, or ends the command.
void Rasterizer::stepBackward() {
  RasterAgent &Agent = *Agents[Backward->Turn];
  if (Backward->Next) {
    Agent.offer(*Backward->Next);
    if (Backward->Run.isDone())
      Backward->Next.reset();
    else
      nextBatch();
    return;
  }
  Agent.offer({});
  Agent.complete(Backward->Status, Backward->Counts);
  Backward.reset();
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
    HandOvers.push_back({&Agent, Done.What.TailRecord});
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
  if (!Backward && !Blending) {
    while (!Agents[Next]->hasCommand())
      Next = (Next + 1) % Agents.size();
    const std::size_t Turn = Next;
    Next = (Next + 1) % Agents.size();
    if (Agents[Turn]->front().isBackward())
      startBackward(Turn);
    else
      Blending.emplace(Turn, *Agents[Turn], Memory, *Tile, *Lanes, Log);
  }
  if (Backward)
    stepBackward();
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
