#include "raster/TileRun.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vorion::raster {

TileRun::TileRun(RasterAgent &Served, RasterMemory &Global, TileBuffer &Buffer,
                 const Datapath &Unit, const WorkLog *Log)
    : Agent(Served), Current(Served.front()),
      Work(beginCommand(Served, Global)), Memory(Global), Tile(Buffer),
      Lanes(Unit), List(Task, Global), KeepsFetches(Log && Log->wantsFetches()),
      Tests(KeepsFetches ? Log->blockTests() : 0) {
  if (Log)
    Work.Pushed = Current.Pushed;
  if (!Work.hasFailed())
    Tile.reset(Task.X, Task.Y, Task.Width, Task.Height);
}

void TileRun::blendOne(const Gaussian &G, uint32_t Address, bool Intersects,
                       const BlendOptions &Options) {
  const BoxWork Result = blendFunction(Task, Lanes)(G, Options, Tile);
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
    Work.Gaussians.back().BlockPixels = Left.Pixels;
  }
}

/// True, as of the others, once there is nothing left to blend.
bool TileRun::blendPushed() {
  for (const Gaussian &G : Current.Pushed) {
    if (Tile.Live == 0)
      break;
    ++Work.Counts.Gaussians;
    Work.Status = checkGaussian(G);
    if (Work.hasFailed())
      break;
    blendOne(G, 0, (G.Tag & VR_INTERSECT) != 0, Task.Blend);
  }
  return true;
}

/// Whether a reason to hand over holds with \p Remaining entries left.
bool TileRun::isTail(uint32_t Remaining) const {
  const uint64_t Pixels = uint64_t{Task.Width} * Task.Height;
  const uint64_t Saturated = Pixels - Tile.Live;
  return Remaining <= Task.TailCount ||
         (Task.TailShare != 0 &&
          Saturated * VR_TAIL_WHOLE >= Task.TailShare * Pixels);
}

bool TileRun::blendList() {
  BlendOptions Options = Task.Blend;
  Fetched Entry;
  const uint32_t End = Done + std::min(LongestStretch, Task.Count - Done);
  for (; Done != End && Tile.Live != 0; ++Done) {
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
  return Done == Task.Count || Tile.Live == 0;
}

bool TileRun::blend() {
  if (Work.hasFailed())
    return true;
  return Task.TakesPushed ? blendPushed() : blendList();
}

void TileRun::copyRow(unsigned Row, std::byte *To) const {
  for (unsigned Column = 0; Column != Task.Width; ++Column) {
    const unsigned At = Row * TileBuffer::Stride + Column;
    // T's sign says "saturated", no more.
    const Pixel P{Tile.R[At], Tile.G[At], Tile.B[At], std::fabs(Tile.T[At])};
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
  Record.LiveCount = Tile.Live;
  for (unsigned Row = 0; Row != Task.Height; ++Row)
    for (unsigned Column = 0; Column != Task.Width; ++Column)
      if (!std::signbit(Tile.T[Row * TileBuffer::Stride + Column]))
        Record.Live[2 * Row + Column / 32] |= 1U << Column % 32;
  std::memcpy(Memory.range(Task.TailRecord, sizeof(Record)), &Record,
              sizeof(Record));
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
    Work.Saturated = uint32_t{Task.Width} * Task.Height - Tile.Live;
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
