#include "raster/CommandInput.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace vorion::raster {

static std::byte *rangeAt(RasterMemory &Memory, std::uint64_t Addr,
                          std::uint64_t Bytes) {
  return Addr <= std::numeric_limits<std::uint32_t>::max()
             ? Memory.range(static_cast<std::uint32_t>(Addr), Bytes)
             : nullptr;
}

std::byte *outputRow(const Command &C, RasterMemory &Memory, unsigned Row) {
  return rangeAt(Memory, C.Output + std::uint64_t{Row} * C.OutputPitch,
                 TileShapeWidth.get(C.TileShape) * sizeof(Pixel));
}

static bool isKnown(const Command &C) {
  const std::uint32_t KnownMode = ModePushed.put(1) | ModeDrain.put(1);
  const std::uint32_t KnownOptions =
      OptionsExp.put(OptionsExp.mask()) | OptionsStopAtEqual.put(1) |
      OptionsSkipSaturated.put(1) | OptionsBlend.put(OptionsBlend.mask()) |
      OptionsAlphaCutoff.put(OptionsAlphaCutoff.mask());
  const std::uint32_t Parts = ZtileCount.get(C.Ztile);
  return (C.Mode & ~KnownMode) == 0 && (C.Options & ~KnownOptions) == 0 &&
         OptionsExp.get(C.Options) < ExpUnitCount &&
         OptionsBlend.get(C.Options) < BlendUnitCount &&
         ZtileIndex.get(C.Ztile) < (Parts == 0 ? 1 : Parts);
}

/// The order of these checks is the order of docs/rasterizer.md#status-codes.
std::uint32_t checkCommand(const Command &C, RasterMemory &Memory) {
  const bool Takes = ModePushed.get(C.Mode) != 0;
  const bool Drains = ModeDrain.get(C.Mode) != 0;
  const unsigned Width = TileShapeWidth.get(C.TileShape);
  const unsigned Height = TileShapeHeight.get(C.TileShape);
  if (!isKnown(C))
    return VR_BAD_MODE;
  if (Width < 1 || Width > VR_MAX_TILE || Height < 1 || Height > VR_MAX_TILE)
    return VR_BAD_SHAPE;
  const auto Cutoff = std::bit_cast<float>(C.Cutoff);
  if (!(Cutoff >= 0.0F && Cutoff < 1.0F))
    return VR_BAD_CUTOFF;
  if (Takes ? C.PushedTooMany : C.Count > VR_MAX_COUNT)
    return VR_BAD_COUNT;
  if (C.TailShare > VR_TAIL_WHOLE || (C.mayHandOver() && (Takes || Drains)))
    return VR_BAD_TAIL;
  if ((!Takes && (C.Gaussians % 16 != 0 || C.List % 4 != 0)) ||
      (!Drains && (C.Output % 16 != 0 || C.OutputPitch % 16 != 0)) ||
      (C.mayHandOver() && C.TailRecord % 16 != 0))
    return VR_MISALIGNED;
  if (!Takes && C.Count != 0 && !Memory.range(C.List, 4ULL * C.Count))
    return VR_UNMAPPED;
  for (unsigned Row = 0; !Drains && Row != Height; ++Row)
    if (!outputRow(C, Memory, Row))
      return VR_UNMAPPED;
  if (C.mayHandOver() && !Memory.range(C.TailRecord, sizeof(Tail)))
    return VR_UNMAPPED;
  return VR_OK;
}

BlendOptions blendOptions(const Command &C) {
  const auto Cutoff = std::bit_cast<float>(C.Cutoff);
  // T' <= cutoff is T' < the next float: one comparison serves both rules.
  return {OptionsStopAtEqual.get(C.Options)
              ? std::nextafter(Cutoff, std::numeric_limits<float>::infinity())
              : Cutoff,
          static_cast<float>(1U << OptionsAlphaCutoff.get(C.Options)) / 255.0F,
          OptionsSkipSaturated.get(C.Options) != 0};
}

Datapath::BlendFunction blendFunction(const Command &C, const Datapath &Lanes) {
  return Lanes.Blend[OptionsExp.get(C.Options)][OptionsBlend.get(C.Options)];
}

LaneUnits laneUnits(const Command &C) {
  return {static_cast<std::uint8_t>(OptionsExp.get(C.Options)),
          static_cast<std::uint8_t>(OptionsBlend.get(C.Options))};
}

std::uint32_t checkGaussian(const Gaussian &G) {
  const float Floats[] = {G.Mean[0],  G.Mean[1],   G.Conic[0], G.Conic[1],
                          G.Conic[2], G.Opacity,   G.Color[0], G.Color[1],
                          G.Color[2], G.Extent[0], G.Extent[1]};
  bool Found = false;
  for (const float F : Floats)
    Found |= std::isnan(F);
  return Found ? VR_NAN : VR_OK;
}

GaussianList::GaussianList(const Command &Of, RasterMemory &Global)
    : C(Of), Memory(Global),
      Entries(C.Count == 0 ? nullptr : Memory.range(C.List, 4ULL * C.Count)) {}

std::uint32_t GaussianList::entry(std::uint32_t I) const {
  std::uint32_t Word = 0;
  std::memcpy(&Word, Entries + 4ULL * I, 4);
  return Word;
}

std::uint64_t GaussianList::address(std::uint32_t Entry) const {
  const std::uint64_t Number = Entry & ~VR_INTERSECT;
  return C.Gaussians + Number * sizeof(Gaussian);
}

/// The record that a list's word names, or nullptr if it is not there.
const std::byte *GaussianList::record(std::uint32_t Entry) const {
  return rangeAt(Memory, address(Entry), sizeof(Gaussian));
}

std::uint32_t GaussianList::fetch(std::uint32_t I, Fetched &Out) const {
  // The host's caches do not see a list's records coming: a third of the time
  // of small Gaussians, measured in bench/raster.
  constexpr std::uint32_t Ahead = 8;
  if (I + Ahead < C.Count)
    if (const std::byte *Soon = record(entry(I + Ahead)))
      __builtin_prefetch(Soon);
  const std::uint32_t Entry = entry(I);
  const std::byte *Record = record(Entry);
  if (!Record)
    return VR_UNMAPPED;
  std::memcpy(&Out.Record, Record, sizeof(Out.Record));
  Out.Address = static_cast<std::uint32_t>(address(Entry));
  Out.Intersects = (Entry & VR_INTERSECT) != 0;
  return checkGaussian(Out.Record);
}

} // namespace vorion::raster
