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
  const uint64_t Pitch = J.OutputPitch / sizeof(Pixel) * Bytes;
  return rangeAt(Memory, First + Row * Pitch, uint64_t{J.Width} * Bytes);
}

std::byte *outputRow(const Job &J, RasterMemory &Memory, unsigned Row) {
  return pixelRow(J, Memory, J.Output, Row, sizeof(Pixel));
}

std::byte *lastRow(const Job &J, RasterMemory &Memory, unsigned Row) {
  return pixelRow(J, Memory, J.Last, Row, sizeof(uint32_t));
}

std::byte *upstreamRow(const Job &J, RasterMemory &Memory, unsigned Row) {
  return pixelRow(J, Memory, J.Upstream, Row, sizeof(Pixel));
}

uint32_t checkGaussian(const Gaussian &G) {
  const float Floats[] = {G.Mean[0],  G.Mean[1],   G.Conic[0], G.Conic[1],
                          G.Conic[2], G.Opacity,   G.Color[0], G.Color[1],
                          G.Color[2], G.Extent[0], G.Extent[1]};
  bool Found = false;
  for (const float F : Floats)
    Found |= std::isnan(F);
  return Found ? VR_NAN : VR_OK;
}

GaussianList::GaussianList(const Job &J, RasterMemory &Global)
    : Gaussians(J.Gaussians), Count(J.Count), Memory(Global),
      Entries(Count == 0 ? nullptr : Memory.range(J.List, 4ULL * Count)) {}

uint32_t GaussianList::entry(uint32_t I) const {
  uint32_t Word = 0;
  std::memcpy(&Word, Entries + 4ULL * I, 4);
  return Word;
}

uint64_t GaussianList::address(uint32_t Entry) const {
  const uint64_t Number = Entry & ~VR_INTERSECT;
  return Gaussians + Number * sizeof(Gaussian);
}

/// The record that a list's word names, or nullptr if it is not there.
const std::byte *GaussianList::record(uint32_t Entry) const {
  return rangeAt(Memory, address(Entry), sizeof(Gaussian));
}

uint32_t GaussianList::fetch(uint32_t I, Fetched &Out) const {
  if (I % LongestStretch == 0 && Memory.isOver())
    return VR_UNMAPPED;
  // The host's caches do not see a list's records coming: a third of the time
  // of small Gaussians, measured in bench/raster.
  constexpr uint32_t Ahead = 8;
  if (I + Ahead < Count)
    if (const std::byte *Soon = record(entry(I + Ahead)))
      __builtin_prefetch(Soon);
  const uint32_t Entry = entry(I);
  const std::byte *Record = record(Entry);
  if (!Record)
    return VR_UNMAPPED;
  std::memcpy(&Out.Record, Record, sizeof(Out.Record));
  Out.Address = static_cast<uint32_t>(address(Entry));
  Out.Intersects = (Entry & VR_INTERSECT) != 0;
  return checkGaussian(Out.Record);
}

} // namespace vorion::raster
