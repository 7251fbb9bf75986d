#include "raster/CommandInput.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace vorion::raster {

CommandWork beginCommand(const RasterAgent &Agent, RasterMemory &Memory) {
  CommandWork W;
  W.Core = Agent.core();
  W.What = checkCommand(Agent.front(), Memory);
  W.Status = W.What.Refusal;
  W.Counts.Commands = 1;
  return W;
}

static std::byte *rangeAt(RasterMemory &Memory, uint64_t Addr, uint64_t Bytes) {
  return Addr <= std::numeric_limits<uint32_t>::max()
             ? Memory.range(static_cast<uint32_t>(Addr), Bytes)
             : nullptr;
}

static std::byte *pixelRow(const Job &J, RasterMemory &Memory, uint32_t First,
                           unsigned Row, unsigned Bytes) {
  const uint64_t Pitch = J.OutputPitch / J.pixelBytes() * Bytes;
  return rangeAt(Memory, First + Row * Pitch, uint64_t{J.Width} * Bytes);
}

std::byte *outputRow(const Job &J, RasterMemory &Memory, unsigned Row) {
  return pixelRow(J, Memory, J.Output, Row, J.pixelBytes());
}

std::byte *lastRow(const Job &J, RasterMemory &Memory, unsigned Row) {
  return pixelRow(J, Memory, J.Last, Row, sizeof(uint32_t));
}

std::byte *upstreamRow(const Job &J, RasterMemory &Memory, unsigned Row) {
  return pixelRow(J, Memory, J.Upstream, Row, sizeof(Pixel));
}

std::byte *limitRow(const Job &J, RasterMemory &Memory, unsigned Row) {
  return pixelRow(J, Memory, J.Limit, Row, sizeof(uint32_t));
}

std::byte *fromRow(const Job &J, RasterMemory &Memory, unsigned Row) {
  return pixelRow(J, Memory, J.From, Row, sizeof(uint32_t));
}

uint32_t checkFloats(std::span<const float> Floats) {
  bool Found = false;
  for (const float F : Floats)
    Found |= std::isnan(F);
  return Found ? VR_NAN : VR_OK;
}

uint32_t checkRecord(const Gaussian &G) {
  const float Floats[] = {G.Mean[0],  G.Mean[1],   G.Conic[0], G.Conic[1],
                          G.Conic[2], G.Opacity,   G.Color[0], G.Color[1],
                          G.Color[2], G.Extent[0], G.Extent[1]};
  return checkFloats(Floats);
}

uint32_t checkRecord(const RayGaussian &G) {
  const float Floats[] = {G.Mean[0],   G.Mean[1],  G.Factor[0], G.Factor[1],
                          G.Factor[2], G.Slope[0], G.Slope[1],  G.Near,
                          G.Opacity,   G.Color[0], G.Color[1],  G.Color[2]};
  return checkFloats(Floats);
}

ListReader::ListReader(const Job &J, RasterMemory &Global, uint32_t Bytes)
    : Records(J.Gaussians), RecordBytes(Bytes), Count(J.Count), Memory(Global),
      Entries(Count == 0 ? nullptr : Memory.range(J.List, 4ULL * Count)) {}

uint32_t ListReader::entry(uint32_t I) const {
  uint32_t Word = 0;
  std::memcpy(&Word, Entries + 4ULL * I, 4);
  return Word;
}

uint64_t ListReader::address(uint32_t Entry) const {
  const uint64_t Number = Entry & ~VR_INTERSECT;
  return Records + Number * RecordBytes;
}

/// The record that a list's word names, or nullptr if it is not there.
const std::byte *ListReader::record(uint32_t Entry) const {
  return rangeAt(Memory, address(Entry), RecordBytes);
}

const std::byte *ListReader::find(uint32_t I, uint32_t &Address,
                                  bool &Intersects) const {
  if (I % LongestStretch == 0 && Memory.isOver())
    return nullptr;
  // The host's caches do not see a list's records coming: a third of the time
  // of small Gaussians, measured in bench/raster.
  constexpr uint32_t Ahead = 8;
  if (I + Ahead < Count)
    if (const std::byte *Soon = record(entry(I + Ahead)))
      __builtin_prefetch(Soon);
  const uint32_t Entry = entry(I);
  Address = static_cast<uint32_t>(address(Entry));
  Intersects = (Entry & VR_INTERSECT) != 0;
  return record(Entry);
}

} // namespace vorion::raster
