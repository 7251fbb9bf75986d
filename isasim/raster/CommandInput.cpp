#include "raster/CommandInput.h"

#include "raster/Reciprocals.h"

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

static std::byte *pixelRow(const Command &C, RasterMemory &Memory,
                           std::uint32_t First, unsigned Row, unsigned Bytes) {
  const std::uint64_t Pitch = C.OutputPitch / sizeof(Pixel) * Bytes;
  return rangeAt(Memory, First + Row * Pitch,
                 std::uint64_t{TileShapeWidth.get(C.TileShape)} * Bytes);
}

std::byte *outputRow(const Command &C, RasterMemory &Memory, unsigned Row) {
  return pixelRow(C, Memory, C.Output, Row, sizeof(Pixel));
}

std::byte *lastRow(const Command &C, RasterMemory &Memory, unsigned Row) {
  return pixelRow(C, Memory, C.Last, Row, sizeof(std::uint32_t));
}

std::byte *upstreamRow(const Command &C, RasterMemory &Memory, unsigned Row) {
  return pixelRow(C, Memory, C.Upstream, Row, sizeof(Pixel));
}

/// Training takes whole lists in memory: positions in them are what a pixel's
/// last contributor is.
static bool isKnownTraining(const Command &C) {
  const std::uint32_t Known =
      BackwardReciprocal.put(BackwardReciprocal.mask()) |
      BackwardClampStops.put(1) | BackwardInRows.put(1);
  if (!C.isBackward())
    return ModeKeepLast.get(C.Mode) == 0 ||
           (C.Mode == ModeKeepLast.put(1) && ZtileCount.get(C.Ztile) <= 1);
  return C.Mode == ModeBackward.put(1) &&
         OptionsBlend.get(C.Options) == VR_BLEND_FP32 &&
         ZtileCount.get(C.Ztile) <= 1 && (C.Backward & ~Known) == 0 &&
         BackwardReciprocal.get(C.Backward) < ReciprocalCount;
}

static bool isKnown(const Command &C) {
  const std::uint32_t KnownMode = ModeBackward.put(1) | ModePushed.put(1) |
                                  ModeDrain.put(1) | ModeKeepLast.put(1);
  const std::uint32_t KnownOptions =
      OptionsExp.put(OptionsExp.mask()) | OptionsStopAtEqual.put(1) |
      OptionsSkipSaturated.put(1) | OptionsBlend.put(OptionsBlend.mask()) |
      OptionsAlphaCutoff.put(OptionsAlphaCutoff.mask());
  const std::uint32_t Parts = ZtileCount.get(C.Ztile);
  return (C.Mode & ~KnownMode) == 0 && (C.Options & ~KnownOptions) == 0 &&
         OptionsExp.get(C.Options) < ExpUnitCount &&
         OptionsBlend.get(C.Options) < BlendUnitCount &&
         ZtileIndex.get(C.Ztile) < (Parts == 0 ? 1 : Parts) &&
         isKnownTraining(C);
}

static bool isShape(const Command &C) {
  const unsigned Width = TileShapeWidth.get(C.TileShape);
  const unsigned Height = TileShapeHeight.get(C.TileShape);
  return Width >= 1 && Width <= VR_MAX_TILE && Height >= 1 &&
         Height <= VR_MAX_TILE &&
         (!C.isBackward() || Width * Height <= VR_MAX_BACKWARD);
}

/// The order of these checks is the order of docs/rasterizer.md#status-codes.
std::uint32_t checkCommand(const Command &C, RasterMemory &Memory) {
  const bool Takes = ModePushed.get(C.Mode) != 0;
  const bool Drains = ModeDrain.get(C.Mode) != 0;
  const bool Back = C.isBackward();
  const bool Lasts = Back || ModeKeepLast.get(C.Mode) != 0;
  if (!isKnown(C))
    return VR_BAD_MODE;
  if (!isShape(C))
    return VR_BAD_SHAPE;
  const auto Cutoff = std::bit_cast<float>(C.Cutoff);
  if (!(Cutoff >= 0.0F && Cutoff < 1.0F))
    return VR_BAD_CUTOFF;
  if (Takes ? C.PushedTooMany : C.Count > VR_MAX_COUNT)
    return VR_BAD_COUNT;
  if (C.TailShare > VR_TAIL_WHOLE ||
      (C.mayHandOver() && (Takes || Drains || Lasts)))
    return VR_BAD_TAIL;
  if ((!Takes && (C.Gaussians % 16 != 0 || C.List % 4 != 0)) ||
      (!Drains && (C.Output % 16 != 0 || C.OutputPitch % 16 != 0)) ||
      (C.mayHandOver() && C.TailRecord % 16 != 0) ||
      (Lasts && C.Last % 4 != 0) || (Back && C.Upstream % 16 != 0))
    return VR_MISALIGNED;
  if (!Takes && C.Count != 0 && !Memory.range(C.List, 4ULL * C.Count))
    return VR_UNMAPPED;
  const unsigned Height = TileShapeHeight.get(C.TileShape);
  for (unsigned Row = 0; Row != Height; ++Row)
    if ((!Drains && !outputRow(C, Memory, Row)) ||
        (Lasts && !lastRow(C, Memory, Row)) ||
        (Back && !upstreamRow(C, Memory, Row)))
      return VR_UNMAPPED;
  if (C.mayHandOver() && !Memory.range(C.TailRecord, sizeof(Tail)))
    return VR_UNMAPPED;
  return VR_OK;
}

float leastAlpha(const Command &C) {
  return static_cast<float>(1U << OptionsAlphaCutoff.get(C.Options)) / 255.0F;
}

BlendOptions blendOptions(const Command &C) {
  const auto Cutoff = std::bit_cast<float>(C.Cutoff);
  // T' <= cutoff is T' < the next float: one comparison serves both rules.
  return {OptionsStopAtEqual.get(C.Options)
              ? std::nextafter(Cutoff, std::numeric_limits<float>::infinity())
              : Cutoff,
          leastAlpha(C), OptionsSkipSaturated.get(C.Options) != 0};
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
  // Of the largest tiles without an end: milliseconds.
  constexpr std::uint32_t LongestStretch = 4096;
  if (I % LongestStretch == 0 && Memory.isOver())
    return VR_UNMAPPED;
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
