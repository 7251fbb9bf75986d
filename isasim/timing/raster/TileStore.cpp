#include "timing/raster/TileStore.h"

#include "raster/RasterTables.h"

#include <algorithm>

namespace vorion::isasim {

TileStore::TileStore(const TimingConfig &Params, MemoryPort PortIn)
    : PortCycles(Params.Raster.PortCycles),
      WriteCycles(MemorySystem::writeCycles(Params)), Port(PortIn) {}

uint32_t TileStore::writeLine(MemorySystem &Memory, GaussianFetch &Fetch,
                              const raster::Job &J, Place &Next, unsigned Set) {
  const uint32_t RowBytes = J.Width * J.pixelBytes();
  const uint32_t Address = J.Output + Next.Row * J.OutputPitch + Next.Byte;
  const uint32_t Line = lineOf(Address);
  const uint32_t Bytes =
      std::min(Line + TimingLineBytes - Address, RowBytes - Next.Byte);
  Fetch.beginSet(Set);
  Fetch.line(Memory, Set, Line,
             Bytes == TimingLineBytes ? CacheOp::WriteWhole : CacheOp::Write);
  Next.Byte += Bytes;
  if (Next.Byte == RowBytes)
    Next = {Next.Row + 1, 0};
  return Bytes / J.pixelBytes();
}

uint64_t TileStore::goesOnAt(const GaussianFetch &Fetch, unsigned Set,
                             uint64_t Earliest, const raster::Job &J,
                             const Place &Next) const {
  const uint64_t Taken = Fetch.readyAt(Set);
  if (Taken == Turn::Never)
    return Turn::Never;
  return std::max(Earliest, Taken > WriteCycles ? Taken - WriteCycles : 0) +
         (Next.Row == J.Height ? PortCycles : 0);
}

uint64_t TileStore::writeRest(MemorySystem &Memory,
                              const raster::CommandWork &Of,
                              uint64_t Then) const {
  const auto Write = [&](uint32_t Line) {
    Memory.access(Port, {.Now = Then++, .Address = Line, .Op = CacheOp::Write});
  };
  if (Of.What.KeepsLast && !Of.What.IsBackward && !Of.hasFailed())
    for (unsigned Row = 0; Row != Of.What.Height; ++Row) {
      const uint32_t First = Of.What.Last + Row * (Of.What.OutputPitch / 4);
      const uint32_t End = First + Of.What.Width * 4;
      for (uint32_t Line = lineOf(First); Line < End; Line += TimingLineBytes)
        Write(Line);
    }
  if (Of.What.KeepsCounts && !Of.What.IsBackward && !Of.hasFailed())
    Write(lineOf(Of.What.Last));
  if (Of.HandedOver)
    for (uint32_t Byte = 0; Byte < Of.What.tailBytes(); Byte += TimingLineBytes)
      Write(Of.What.TailRecord + Byte);
  return Then;
}

} // namespace vorion::isasim
