#include "raster/TileRun.h"

#include <algorithm>
#include <cstring>

namespace vorion::raster {

TileRun::TileRun(RasterAgent &Served, RasterMemory &Global, TileBuffer &Buffer,
                 const Datapath &Unit, const WorkLog *Log)
    : Agent(Served), Current(Served.front()),
      Work(beginCommand(Served, Global)), Memory(Global), Tile(Buffer),
      Lanes(Unit), KeepsFetches(Log && Log->wantsFetches()),
      Tests(KeepsFetches ? Log->blockTests() : 0) {
  if (Log)
    Work.Pushed = Current.Pushed;
  if (Work.hasFailed())
    return;
  Tile.reset(Task.X, Task.Y, Task.Width, Task.Height);
  if (Task.LoadsPixels)
    loadPixels();
  Ranges.emplace(Task, Memory, Tile);
  // Nobody fetches what no pixel takes.
  Done = Work.First = Ranges->first(
      Task.TakesPushed ? static_cast<uint32_t>(Current.Pushed.size())
                       : Task.Count);
}

void TileRun::loadPixels() {
  for (unsigned Row = 0; Row != Task.Height; ++Row) {
    const std::byte *From = outputRow(Task, Memory, Row);
    for (unsigned Column = 0; Column != Task.Width; ++Column) {
      Pixel P;
      std::memcpy(&P, From + Column * sizeof(P), sizeof(P));
      Tile.set(Row, Column, P);
    }
  }
}

template <typename Record>
void TileRun::blendOne(const Record &G, uint32_t Address, bool Intersects,
                       const BlendOptions &Options) {
  const BoxWork Result = blendFunction<Record>(Task, Lanes)(G, Options, Tile);
  Work.Counts.Intersecting += Intersects;
  Work.Counts.Clipped += Result.Clipped;
  Work.Counts.Fragments += Result.Fragments;
  Work.Counts.Blends += Result.Blends;
  if (KeepsFetches)
    Work.Gaussians.push_back(
        {Address, Result.X, Result.Y, Result.Width, Result.Height,
         static_cast<uint16_t>(Result.Fragments), Intersects});
  if (Tests.any() && !Result.Clipped) {
    const BlockWork Left = Tests.count(G, Result, Options.MinAlpha, Tile);
    Work.Gaussians.back().Blocks = Left.Blocks;
    Work.Gaussians.back().ChosenPixels = Left.Pixels;
  }
}

/// True, as of the others, once there is nothing left to blend.
bool TileRun::blendPushed() {
  for (; Done != Current.Pushed.size() && Ranges->goTo(Done); ++Done) {
    const Gaussian &G = Current.Pushed[Done];
    ++Work.Counts.Gaussians;
    Work.Status = checkRecord(G);
    if (Work.hasFailed())
      break;
    blendOne(G, 0, (G.Tag & VR_INTERSECT) != 0, Task.Blend);
  }
  return true;
}

/// Whether a reason to hand over holds with \p Remaining entries left.
bool TileRun::isTail(uint32_t Remaining) const {
  const uint64_t Pixels = uint64_t{Task.Width} * Task.Height;
  const uint64_t Saturated = Pixels - Ranges->left();
  return Remaining <= Task.TailCount ||
         (Task.TailShare != 0 &&
          Saturated * VR_TAIL_WHOLE >= Task.TailShare * Pixels);
}

template <typename Record> bool TileRun::blendList() {
  const RecordList<Record> List(Task, Memory);
  BlendOptions Options = Task.Blend;
  FetchedRecord<Record> Entry;
  const uint32_t End = Done + std::min(LongestStretch, Task.Count - Done);
  for (; Done != End && Ranges->goTo(Done); ++Done) {
    if (Task.mayHandOver() && isTail(Task.Count - Done)) {
      Work.HandedOver = true;
      return true;
    }
    Work.Status = List.fetch(Done, Entry);
    Work.Counts.Gaussians += Work.Status != VR_UNMAPPED;
    if (Work.hasFailed())
      return true;
    Options.Entry = Done;
    blendOne(Entry.Record, Entry.Address, Entry.Intersects, Options);
  }
  return Done == Task.Count || Ranges->left() == 0;
}

bool TileRun::blend() {
  if (Work.hasFailed())
    return true;
  if (Task.TakesPushed)
    return blendPushed();
  return Task.Units.isConic() ? blendList<Gaussian>()
                              : blendList<RayGaussian>();
}

void TileRun::copyRow(unsigned Row, std::byte *To) const {
  for (unsigned Column = 0; Column != Task.Width; ++Column) {
    const Pixel P = Ranges->written(Row, Column);
    std::memcpy(To + Column * sizeof(Pixel), &P, sizeof(Pixel));
  }
}

void TileRun::writePixels() const {
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
void TileRun::writeTail() const {
  Tail Record{};
  Record.Rest = Current;
  Record.Rest.List += 4 * Done;
  Record.Rest.Count -= Done;
  Record.Core = Work.Core;
  Record.LiveCount = Ranges->left();
  for (unsigned Row = 0; Row != Task.Height; ++Row) {
    const uint64_t Left = Ranges->leftOf(Row);
    Record.Live[2 * Row] = static_cast<uint32_t>(Left);
    Record.Live[2 * Row + 1] = static_cast<uint32_t>(Left >> 32);
  }
  std::byte *To = Memory.range(Task.TailRecord, Task.tailBytes());
  std::memcpy(To, &Record, sizeof(Record));
  if (!Task.hasTailRange())
    return;
  const TailRange Range{Current.Mode & TailRangeModes, Task.Limit,
                        Task.LimitFirst + Done, Task.From};
  std::memcpy(To + sizeof(Record), &Range, sizeof(Range));
}

void TileRun::writeCounts() const {
  const auto Word = [](uint64_t Count) {
    return static_cast<uint32_t>(std::min<uint64_t>(Count, ~uint32_t{0}));
  };
  const uint32_t Words[] = {Word(Work.Counts.Gaussians),
                            Word(Work.Counts.Fragments)};
  static_assert(sizeof(Words) == CountsBytes);
  std::memcpy(Memory.range(Task.Last, CountsBytes), Words, CountsBytes);
}

void TileRun::writeResult() {
  if (!Work.hasFailed()) {
    Work.Saturated = uint32_t{Task.Width} * Task.Height - Ranges->left();
    writePixels();
    if (Task.KeepsCounts)
      writeCounts();
  }
  if (Work.HandedOver)
    writeTail();
}

bool TileRun::goOn() {
  const bool IsDone = blend();
  if (IsDone)
    writeResult();
  return IsDone;
}

} // namespace vorion::raster
