#include "pixel/PixelUnit.h"

#include "raster/CommandInput.h"
#include "raster/PixelRanges.h"

#include <cmath>
#include <cstring>
#include <optional>

namespace vorion::pixel {

using namespace raster;

namespace {

/// One hand-over in the works.
class Execution {
public:
  /// \p KeepFetches: records and pixels too, for the log.
  Execution(const HandOver &Next, RasterMemory &Global, TileBuffer &Buffer,
            const Datapath &Unit, bool KeepFetches);

  /// To be called once.
  TailWork run();

private:
  bool isLive(unsigned Row, unsigned Column) const {
    return (Record.Live[2 * Row + Column / 32] >> Column % 32 & 1) != 0;
  }
  /// Calls Use(row of pixels in memory, its place in the tile, column).
  template <typename Function> void forLivePixels(Function Use);
  void loadPixels();
  uint32_t blend();
  void storePixels();
  void keepVisits(uint32_t Examined);

  RasterMemory &Memory;
  TileBuffer &Tile;
  const Datapath &Lanes;
  bool KeepsFetches;
  Tail Record;
  std::optional<PixelRanges> Ranges;
  TailWork Work;
  const Job &Task = Work.What;
};

Execution::Execution(const HandOver &Next, RasterMemory &Global,
                     TileBuffer &Buffer, const Datapath &Unit, bool KeepFetches)
    : Memory(Global), Tile(Buffer), Lanes(Unit), KeepsFetches(KeepFetches) {
  std::memcpy(&Record, Memory.range(Next.Record, sizeof(Record)),
              sizeof(Record));
  Work.Core = Next.Agent->core();
  Work.Record = Next.Record;
  // From memory, which anyone may have overwritten: it is checked as a command
  // is.
  Command Rest;
  static_cast<TileWords &>(Rest) = Record.Rest;
  if (Next.HasRange) {
    TailRange Range;
    std::memcpy(&Range,
                Memory.range(Next.Record + sizeof(Record), sizeof(Range)),
                sizeof(Range));
    Rest.Mode = Range.Mode;
    Rest.Limit = Range.Limit;
    Rest.LimitFirst = Range.LimitFirst;
    Rest.From = Range.From;
  }
  Work.What = checkCommand(Rest, Memory);
  if (Rest.Mode & ~TailRangeModes)
    Work.What.Refusal = VR_BAD_MODE;
  Work.Status = Task.Refusal;
  Work.Counts.Tails = 1;
}

/// \p Examined Gaussians have been seen by every pixel that is open, or was
/// until the last of them.
void Execution::keepVisits(uint32_t Examined) {
  for (TailWork::OpenPixel &P : Work.Pixels)
    if (P.Visits == 0 &&
        (Examined == Task.Count || (Ranges->leftOf(P.Y) >> P.X & 1) == 0))
      P.Visits = Examined;
}

template <typename Function> void Execution::forLivePixels(Function Use) {
  for (unsigned Row = 0; Row != Task.Height; ++Row) {
    std::byte *Pixels = outputRow(Task, Memory, Row);
    for (unsigned Column = 0; Column != Task.Width; ++Column)
      if (isLive(Row, Column))
        Use(Pixels + Column * sizeof(Pixel), Row, Column);
  }
}

void Execution::loadPixels() {
  Tile.reset(Task.X, Task.Y, Task.Width, Task.Height);
  // All closed but those that the record names.
  for (unsigned Row = 0; Row != Task.Height; ++Row)
    for (unsigned Column = 0; Column != Task.Width; ++Column)
      if (!isLive(Row, Column))
        Tile.set(Row, Column, {0, 0, 0, -1});
  forLivePixels([&](const std::byte *From, unsigned Row, unsigned Column) {
    Pixel P;
    std::memcpy(&P, From, sizeof(P));
    P.T = std::fabs(P.T);
    Tile.set(Row, Column, P);
    if (KeepsFetches)
      Work.Pixels.push_back(
          {static_cast<uint8_t>(Column), static_cast<uint8_t>(Row), 0});
  });
  Ranges.emplace(Task, Memory, Tile);
}

uint32_t Execution::blend() {
  const GaussianList List(Task, Memory);
  Fetched Entry;
  uint32_t LeftBefore = Ranges->left();
  for (uint32_t I = 0; I != Task.Count; ++I) {
    const bool IsLeft = Ranges->goTo(I);
    if (KeepsFetches && Ranges->left() != LeftBefore)
      keepVisits(I);
    if (!IsLeft)
      break;
    LeftBefore = Ranges->left();
    Work.Counts.TailVisits += Tile.Live;
    if (const uint32_t Status = List.fetch(I, Entry))
      return Status;
    Work.Counts.TailBlends +=
        blendFunction<Gaussian>(Task, Lanes)(Entry.Record, Task.Blend, Tile)
            .Blends;
    if (KeepsFetches) {
      Work.Records.push_back(Entry.Address);
      if (Ranges->left() != LeftBefore || I + 1 == Task.Count)
        keepVisits(I + 1);
      LeftBefore = Ranges->left();
    }
  }
  return VR_OK;
}

void Execution::storePixels() {
  forLivePixels([&](std::byte *To, unsigned Row, unsigned Column) {
    const Pixel P = Ranges->written(Row, Column);
    std::memcpy(To, &P, sizeof(P));
  });
}

TailWork Execution::run() {
  if (!Task.Refusal) {
    loadPixels();
    Work.Counts.TailPixels = Ranges->left();
    Work.Status = blend();
  }
  if (Work.Status == VR_OK) {
    Work.Saturated =
        static_cast<uint32_t>(Work.Counts.TailPixels) - Ranges->left();
    storePixels();
  }
  return std::move(Work);
}

} // namespace

PixelUnit::PixelUnit(RasterMemory &Global)
    : Memory(Global), Tile(std::make_unique<TileBuffer>()),
      Lanes(datapaths().back()) {}

PixelUnit::~PixelUnit() = default;

void PixelUnit::accept(std::span<const HandOver> Handed) {
  Queue.insert(Queue.end(), Handed.begin(), Handed.end());
}

bool PixelUnit::hasRoomInLog() const {
  return !Log || !canStep() || Log->hasRoomForTail(Queue.front().Agent->core());
}

bool PixelUnit::step() {
  if (Queue.empty())
    return false;
  const HandOver Next = Queue.front();
  Queue.pop_front();
  const DefaultFloatEnvironment Environment;
  const bool KeepFetches = Log && Log->wantsFetches();
  TailWork Done = Execution(Next, Memory, *Tile, *Lanes, KeepFetches).run();
  Next.Agent->completeTail(Done.Status, Done.Counts);
  if (Log)
    Log->tail(std::move(Done));
  return true;
}

} // namespace vorion::pixel
