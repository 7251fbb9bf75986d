#include "raster/SurfaceRun.h"

#include "raster/CommandInput.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace vorion::raster {
namespace {

template <uint32_t Primitive> class SurfaceRun : public BatchRun {
  using Body = SurfaceBody<Primitive>;

public:
  SurfaceRun(const RasterAgent &Agent, RasterMemory &Global,
             SurfaceBuffer &Buffer, const WorkLog *Log)
      : BatchRun(beginCommand(Agent, Global)), Memory(Global), Tile(Buffer),
        List(Task, Global), KeepsFetches(Log && Log->wantsFetches()) {
    if (!Work.hasFailed())
      load();
  }

  std::optional<Batch> next() override {
    const uint32_t End = Done + std::min(LongestStretch, Task.Count - Done);
    while (Done != End && waiting() < VR_GRAD_LANES && !Work.hasFailed())
      Work.Status = draw(Done++);
    if (isDrawn() && !IsFinished) {
      IsFinished = true;
      if (!Work.hasFailed() && !Task.HandsFragments)
        store();
    }
    return waiting() >= VR_GRAD_LANES || (isDrawn() && waiting() != 0)
               ? std::optional(takeBatch())
               : std::nullopt;
  }

  /// An empty list has a tile to store, too.
  bool isDone() const override {
    return (Work.hasFailed() || IsFinished) && waiting() == 0;
  }

private:
  /// Whether no other entry is looked at. What a command has handed over before
  /// it fails is what it has drawn.
  bool isDrawn() const { return Work.hasFailed() || Done == Task.Count; }
  std::size_t waiting() const { return Fragments.size() - Taken; }

  Batch takeBatch() {
    Batch B;
    B.Number = Number++;
    B.Count =
        static_cast<uint32_t>(std::min<std::size_t>(VR_GRAD_LANES, waiting()));
    for (unsigned Lane = 0; Lane != B.Count; ++Lane)
      B.Items[Lane] = itemOf(Fragments[Taken++]);
    if (waiting() == 0) {
      Fragments.clear();
      Taken = 0;
    }
    return B;
  }

  Visibility *row(unsigned Y) {
    return Tile.Pixels.data() + Y * SurfaceBuffer::Stride;
  }

  void load() {
    for (unsigned Y = 0; Y != Task.Height; ++Y)
      if (Task.Depth.Loads)
        std::memcpy(row(Y), outputRow(Task, Memory, Y),
                    Task.Width * sizeof(Visibility));
      else
        std::fill_n(row(Y), Task.Width,
                    Visibility{Task.Depth.Clear, VR_NO_PRIMITIVE});
  }

  void store() {
    for (unsigned Y = 0; Y != Task.Height; ++Y)
      std::memcpy(outputRow(Task, Memory, Y), row(Y),
                  Task.Width * sizeof(Visibility));
  }

  uint32_t draw(uint32_t Entry) {
    FetchedRecord<typename Body::Record> Input;
    const uint32_t Found = List.fetch(Entry, Input);
    Work.Counts.Gaussians += Found != VR_UNMAPPED;
    if (Found)
      return Found;
    Work.Counts.Intersecting += Input.Intersects;
    // The box cut to the tile, in its pixels.
    const PixelBox All = Body::box(Input.Record);
    const unsigned FirstX = std::max<unsigned>(All.FirstX, Task.X),
                   FirstY = std::max<unsigned>(All.FirstY, Task.Y),
                   EndX = std::min(All.LastX + 1U, Task.X + 0U + Task.Width),
                   EndY = std::min(All.LastY + 1U, Task.Y + 0U + Task.Height);
    GaussianWork Did{Input.Address, 0, 0, 0, 0, 0, Input.Intersects};
    if (FirstX < EndX && FirstY < EndY) {
      Did.X = static_cast<uint8_t>(FirstX - Task.X);
      Did.Y = static_cast<uint8_t>(FirstY - Task.Y);
      Did.Width = static_cast<uint8_t>(EndX - FirstX);
      Did.Height = static_cast<uint8_t>(EndY - FirstY);
      Did.Slots = static_cast<uint16_t>(Did.Width * Did.Height);
      cover(Body(Input.Record, Task.X, Task.Y), Input.Record.Tag, Did);
    }
    Work.Counts.Clipped += Did.Width == 0;
    Work.Counts.Fragments += Did.Slots;
    if (KeepsFetches)
      Work.Gaussians.push_back(Did);
    return VR_OK;
  }

  void cover(const Body &Of, uint32_t Tag, GaussianWork &Did) {
    uint16_t Passed = 0;
    for (unsigned Y = Did.Y; Y != Did.Y + 0U + Did.Height; ++Y)
      for (unsigned X = Did.X; X != Did.X + 0U + Did.Width; ++X) {
        if (!Of.covers(X, Y))
          continue;
        const float Plane = Of.depth(X, Y);
        const float Depth =
            Task.Depth.IsInteger ? std::nearbyint(Plane) : Plane;
        Visibility &Pixel = row(Y)[X];
        if (!passesDepth(Task.Depth.Function, Depth, Pixel.Depth))
          continue;
        ++Passed;
        if (Task.Depth.Writes)
          Pixel = {Depth, Tag};
        if (Task.HandsFragments)
          Fragments.push_back({Tag, (Task.X + X) | (Task.Y + Y) << 16, Depth});
      }
    Work.Counts.Blends += Passed;
    Did.ChosenPixels = Task.HandsFragments ? Passed : 0;
  }

  RasterMemory &Memory;
  SurfaceBuffer &Tile;
  RecordList<typename Body::Record> List;
  bool KeepsFetches;
  uint32_t Done = 0;               ///< entries of the list
  bool IsFinished = false;         ///< with all of them, and has stored
  uint32_t Number = 0;             ///< of the next batch
  std::vector<Fragment> Fragments; ///< not all handed over
  std::size_t Taken = 0;           ///< of these
};

using Maker = std::unique_ptr<BatchRun> (*)(const RasterAgent &, RasterMemory &,
                                            SurfaceBuffer &, const WorkLog *);

template <uint32_t Primitive>
std::unique_ptr<BatchRun> make(const RasterAgent &Agent, RasterMemory &Memory,
                               SurfaceBuffer &Tile, const WorkLog *Log) {
  return std::make_unique<SurfaceRun<Primitive>>(Agent, Memory, Tile, Log);
}

/// By row of FrontEnds. A command that no opaque kind takes is refused, whoever
/// refuses it.
constexpr std::size_t Kinds = std::size(FrontEnds);
constexpr std::array<Maker, Kinds> Makers =
    []<std::size_t... Row>(std::index_sequence<Row...>) {
      return std::array<Maker, Kinds>{make < FrontEnds[Row].IsOpaque
                                          ? FrontEnds[Row].Primitive
                                          : VR_PRIMITIVE_TRIANGLE > ...};
    }(std::make_index_sequence<Kinds>());

} // namespace

std::unique_ptr<BatchRun> makeSurfaceRun(const RasterAgent &Agent,
                                         RasterMemory &Memory,
                                         SurfaceBuffer &Tile,
                                         const WorkLog *Log) {
  const std::size_t Row = frontEndRowOf(ModePrimitive.get(Agent.front().Mode));
  return Makers[Row < Kinds ? Row : 0](Agent, Memory, Tile, Log);
}

} // namespace vorion::raster
