#include "pixel/PixelUnit.h"

#include "raster/CommandInput.h"

#include <cmath>
#include <cstring>

namespace vorion::pixel {

using namespace raster;

Command commandOf(const Tail &Record) {
  Command C;
  C.List = Record.List;
  C.Count = Record.Count;
  C.Gaussians = Record.Gaussians;
  C.Options = Record.Options;
  C.Cutoff = Record.Cutoff;
  C.TileOrigin = Record.TileOrigin;
  C.TileShape = Record.TileShape;
  C.Ztile = Record.Ztile;
  C.Output = Record.Output;
  C.OutputPitch = Record.OutputPitch;
  return C;
}

namespace {

/// One hand-over in the works.
class Execution {
public:
  Execution(const Tail &Handed, RasterMemory &Global, TileBuffer &Buffer,
            const Datapath &Unit)
      : Record(Handed), C(commandOf(Record)), Memory(Global), Tile(Buffer),
        Lanes(Unit) {}

  std::uint32_t run();
  const Counters &work() const { return Work; }

  /// Keeps the details of the work too, of the record at \p Address.
  void keepWork(std::uint32_t Address);
  TailWork takeWork() { return std::move(Kept); }

private:
  bool isLive(unsigned Row, unsigned Column) const {
    return (Record.Live[2 * Row + Column / 32] >> Column % 32 & 1) != 0;
  }
  /// Calls Use(row of pixels in memory, its place in the tile, column).
  template <typename Function> void forLivePixels(Function Use);
  void loadPixels();
  std::uint32_t blend();
  void storePixels();
  void keepVisits(std::uint32_t Examined);

  const Tail &Record;
  const Command C;
  RasterMemory &Memory;
  TileBuffer &Tile;
  const Datapath &Lanes;
  Counters Work;
  bool Keeps = false;
  TailWork Kept;
};

void Execution::keepWork(std::uint32_t Address) {
  Keeps = true;
  Kept = {Address, Record.List, Record.Output, Record.OutputPitch, laneUnits(C),
          {},      {}};
}

/// \p Examined Gaussians have been seen by every pixel that is open, or was
/// until the last of them.
void Execution::keepVisits(std::uint32_t Examined) {
  for (TailWork::OpenPixel &P : Kept.Pixels)
    if (P.Visits == 0 && (Examined == C.Count ||
                          std::signbit(Tile.T[P.Y * TileBuffer::Stride + P.X])))
      P.Visits = Examined;
}

template <typename Function> void Execution::forLivePixels(Function Use) {
  const unsigned Width = TileShapeWidth.get(C.TileShape);
  const unsigned Height = TileShapeHeight.get(C.TileShape);
  for (unsigned Row = 0; Row != Height; ++Row) {
    std::byte *Pixels = outputRow(C, Memory, Row);
    for (unsigned Column = 0; Column != Width; ++Column)
      if (isLive(Row, Column))
        Use(Pixels + Column * sizeof(Pixel), Row, Column);
  }
}

void Execution::loadPixels() {
  Tile.reset(TileOriginX.get(C.TileOrigin), TileOriginY.get(C.TileOrigin),
             TileShapeWidth.get(C.TileShape), TileShapeHeight.get(C.TileShape));
  // All closed but those that the record names.
  for (float &T : Tile.T)
    T = -T;
  for (std::uint32_t &Live : Tile.RowLive)
    Live = 0;
  Tile.Live = 0;
  forLivePixels([&](const std::byte *From, unsigned Row, unsigned Column) {
    Pixel P;
    std::memcpy(&P, From, sizeof(P));
    const unsigned At = Row * TileBuffer::Stride + Column;
    Tile.R[At] = P.R;
    Tile.G[At] = P.G;
    Tile.B[At] = P.B;
    Tile.T[At] = std::fabs(P.T);
    ++Tile.RowLive[Row];
    ++Tile.Live;
    if (Keeps)
      Kept.Pixels.push_back({static_cast<std::uint8_t>(Column),
                             static_cast<std::uint8_t>(Row), 0});
  });
}

std::uint32_t Execution::blend() {
  const BlendOptions Options = blendOptions(C);
  const GaussianList List(C, Memory);
  Fetched Entry;
  for (std::uint32_t I = 0; I != C.Count && Tile.Live != 0; ++I) {
    const std::uint32_t OpenBefore = Tile.Live;
    Work.TailVisits += OpenBefore;
    if (const std::uint32_t Status = List.fetch(I, Entry))
      return Status;
    Work.TailBlends +=
        blendFunction(C, Lanes)(Entry.Record, Options, Tile).Blends;
    if (Keeps) {
      Kept.Records.push_back(Entry.Address);
      if (Tile.Live != OpenBefore || I + 1 == C.Count)
        keepVisits(I + 1);
    }
  }
  return VR_OK;
}

void Execution::storePixels() {
  forLivePixels([&](std::byte *To, unsigned Row, unsigned Column) {
    const unsigned At = Row * TileBuffer::Stride + Column;
    const Pixel P{Tile.R[At], Tile.G[At], Tile.B[At], std::fabs(Tile.T[At])};
    std::memcpy(To, &P, sizeof(P));
  });
}

std::uint32_t Execution::run() {
  Work.Tails = 1;
  if (const std::uint32_t Status = checkCommand(C, Memory))
    return Status;
  loadPixels();
  Work.TailPixels = Tile.Live;
  if (const std::uint32_t Status = blend())
    return Status;
  storePixels();
  return VR_OK;
}

} // namespace

PixelUnit::PixelUnit(RasterMemory &Global)
    : Memory(Global), Tile(std::make_unique<TileBuffer>()),
      Lanes(datapaths().back()) {}

PixelUnit::~PixelUnit() = default;

void PixelUnit::accept(std::span<const HandOver> Handed) {
  Queue.insert(Queue.end(), Handed.begin(), Handed.end());
}

bool PixelUnit::step() {
  if (Queue.empty())
    return false;
  const HandOver Next = Queue.front();
  Queue.pop_front();
  Tail Record;
  std::memcpy(&Record, Memory.range(Next.Record, sizeof(Record)),
              sizeof(Record));
  const DefaultFloatEnvironment Environment;
  Execution Running(Record, Memory, *Tile, *Lanes);
  if (Log)
    Running.keepWork(Next.Record);
  const std::uint32_t Status = Running.run();
  if (Log)
    Log->tail(Next.Agent->core(), Running.takeWork());
  Next.Agent->completeTail(Status, Running.work());
  return true;
}

} // namespace vorion::pixel
