#include "raster/Job.h"

#include "raster/CommandInput.h"
#include "raster/UnitTables.h"

#include <bit>
#include <cmath>
#include <limits>

namespace vorion::raster {

static BlendOptions blendOptions(const Command &C) {
  const auto Cutoff = std::bit_cast<float>(C.Cutoff);
  BlendOptions O{};
  // T' <= cutoff is T' < the next float: one comparison serves both rules.
  O.StopBelow =
      OptionsStopAtEqual.get(C.Options)
          ? std::nextafter(Cutoff, std::numeric_limits<float>::infinity())
          : Cutoff;
  O.MinAlpha =
      static_cast<float>(1U << OptionsAlphaCutoff.get(C.Options)) / 255.0F;
  O.SkipSaturated = OptionsSkipSaturated.get(C.Options) != 0;
  O.Falloff = {OptionsDegree4.get(C.Options) != 0,
               OptionsLowPass.get(C.Options) != 0};
  O.KeepLast = ModeKeepLast.get(C.Mode) != 0;
  return O;
}

static BackwardOptions backwardOptions(const Command &C,
                                       const BlendOptions &Forward) {
  BackwardOptions O;
  O.Unit = static_cast<Reciprocal>(BackwardReciprocal.get(C.Backward));
  O.ClampStops = BackwardClampStops.get(C.Backward) != 0;
  O.InRows = BackwardInRows.get(C.Backward) != 0;
  O.SkipSaturated = Forward.SkipSaturated;
  O.Falloff = Forward.Falloff;
  O.MinAlpha = Forward.MinAlpha;
  return O;
}

static DepthOptions depthOptions(const Command &C) {
  return {static_cast<uint8_t>(DepthFunction.get(C.Depth)),
          DepthWrite.get(C.Depth) != 0, DepthLoad.get(C.Depth) != 0,
          DepthInteger.get(C.Depth) != 0, std::bit_cast<float>(C.DepthClear)};
}

static Job decode(const Command &C) {
  Job J;
  J.IsBackward = C.isBackward();
  J.TakesPushed = ModePushed.get(C.Mode) != 0;
  J.Drains = ModeDrain.get(C.Mode) != 0;
  J.KeepsLast = ModeKeepLast.get(C.Mode) != 0;
  J.KeepsCounts = ModeKeepCounts.get(C.Mode) != 0;
  J.HandsFragments = ModeFragments.get(C.Mode) != 0;
  J.IsLimited = ModeLimited.get(C.Mode) != 0;
  J.StartsLate = ModeFrom.get(C.Mode) != 0;
  J.LoadsPixels = ModeLoad.get(C.Mode) != 0;
  J.KeepsSaturated = ModeKeepSaturated.get(C.Mode) != 0;
  J.X = static_cast<uint16_t>(TileOriginX.get(C.TileOrigin));
  J.Y = static_cast<uint16_t>(TileOriginY.get(C.TileOrigin));
  J.Width = static_cast<uint16_t>(TileShapeWidth.get(C.TileShape));
  J.Height = static_cast<uint16_t>(TileShapeHeight.get(C.TileShape));
  J.Gaussians = C.Gaussians;
  J.List = C.List;
  J.Count = C.Count;
  J.Output = C.Output;
  J.OutputPitch = C.OutputPitch;
  J.Last = C.Last;
  J.Upstream = C.Upstream;
  J.Limit = C.Limit;
  J.LimitFirst = C.LimitFirst;
  J.From = C.From;
  J.TailCount = C.TailCount;
  J.TailShare = C.TailShare;
  J.TailRecord = C.TailRecord;
  J.Units = {expRowOf(OptionsExp.get(C.Options)),
             static_cast<uint8_t>(OptionsBlend.get(C.Options)),
             frontEndRowOf(ModePrimitive.get(C.Mode))};
  J.Blend = blendOptions(C);
  J.Backward = backwardOptions(C, J.Blend);
  J.Depth = depthOptions(C);
  return J;
}

/// Training takes whole lists in memory: positions in them are what a pixel's
/// last contributor is.
static bool isKnownTraining(const Command &C, const Job &J) {
  const uint32_t Known = BackwardReciprocal.put(BackwardReciprocal.mask()) |
                         BackwardClampStops.put(1) | BackwardInRows.put(1);
  const uint32_t Mode = C.Mode & ~ModePrimitive.put(ModePrimitive.mask());
  if (!J.IsBackward)
    return !J.KeepsLast ||
           ((Mode & ~ModeLimited.put(1)) == ModeKeepLast.put(1) &&
            ZtileCount.get(C.Ztile) <= 1);
  return Mode == ModeBackward.put(1) && J.Units.Blend == VR_BLEND_FP32 &&
         ZtileCount.get(C.Ztile) <= 1 && (C.Backward & ~Known) == 0 &&
         static_cast<std::size_t>(J.Backward.Unit) < ReciprocalUnitCount;
}

/// Opaque primitives are tested against depths and do nothing else. Others have
/// no fragments to hand over. What lanes push are conics; rays alone have a
/// falloff.
static bool isKnownPrimitive(const Command &C, const Job &J) {
  const uint32_t OfFalloff = OptionsDegree4.put(1) | OptionsLowPass.put(1);
  if (J.Units.FrontEnd >= std::size(FrontEnds))
    return false;
  if (!J.Units.isOpaque())
    return !J.HandsFragments &&
           (J.Units.isConic() ? (C.Options & OfFalloff) == 0 : !J.TakesPushed);
  const uint32_t Allowed =
      ModePrimitive.put(ModePrimitive.mask()) | ModeFragments.put(1);
  const uint32_t KnownDepth = DepthFunction.put(DepthFunction.mask()) |
                              DepthWrite.put(1) | DepthLoad.put(1) |
                              DepthInteger.put(1);
  return (C.Mode & ~Allowed) == 0 && C.Options == 0 &&
         ZtileCount.get(C.Ztile) <= 1 && (C.Depth & ~KnownDepth) == 0;
}

/// A part of a list is blended from colour 0 on, and a drained tile has no
/// pixels in memory to go on with.
static bool isKnownSequence(const Command &C, const Job &J) {
  return !(J.LoadsPixels || J.KeepsSaturated) ||
         (!J.Drains && ZtileCount.get(C.Ztile) <= 1);
}

static bool isKnown(const Command &C, const Job &J) {
  const uint32_t KnownMode =
      ModeBackward.put(1) | ModePushed.put(1) | ModeDrain.put(1) |
      ModeKeepLast.put(1) | ModeKeepCounts.put(1) |
      ModePrimitive.put(ModePrimitive.mask()) | ModeFragments.put(1) |
      ModeLimited.put(1) | ModeFrom.put(1) | ModeLoad.put(1) |
      ModeKeepSaturated.put(1);
  const uint32_t KnownOptions =
      OptionsExp.put(OptionsExp.mask()) | OptionsStopAtEqual.put(1) |
      OptionsSkipSaturated.put(1) | OptionsBlend.put(OptionsBlend.mask()) |
      OptionsAlphaCutoff.put(OptionsAlphaCutoff.mask()) |
      OptionsDegree4.put(1) | OptionsLowPass.put(1);
  const uint32_t Parts = ZtileCount.get(C.Ztile);
  return (C.Mode & ~KnownMode) == 0 && (C.Options & ~KnownOptions) == 0 &&
         J.Units.Exp < ExpUnitCount && J.Units.Blend < BlendUnitCount &&
         ZtileIndex.get(C.Ztile) < (Parts == 0 ? 1 : Parts) &&
         isKnownTraining(C, J) && isKnownPrimitive(C, J) &&
         isKnownSequence(C, J);
}

static bool isShape(const Job &J) {
  return J.Width >= 1 && J.Width <= VR_MAX_TILE && J.Height >= 1 &&
         J.Height <= VR_MAX_TILE &&
         J.bufferPlaces() <= VR_MAX_TILE * VR_MAX_TILE;
}

// A pixel of more words than a bank's row takes two rows.
static_assert(VR_MAX_BACKWARD == VR_MAX_TILE * VR_MAX_TILE / 2);

static bool isAligned(const Job &J) {
  const uint32_t PixelBytes = J.pixelBytes();
  const bool Lasts = J.IsBackward || J.KeepsLast;
  return (J.TakesPushed || (J.Gaussians % 16 == 0 && J.List % 4 == 0)) &&
         (!J.usesOutput() || J.Output % PixelBytes == 0) &&
         (!(J.usesOutput() || J.rangeWords()) ||
          J.OutputPitch % PixelBytes == 0) &&
         (!J.IsLimited || J.Limit % 4 == 0) &&
         (!J.StartsLate || J.From % 4 == 0) &&
         (!J.mayHandOver() || J.TailRecord % 16 == 0) &&
         (!J.KeepsCounts || J.Last % CountsBytes == 0) &&
         (!Lasts || J.Last % 4 == 0) && (!J.IsBackward || J.Upstream % 16 == 0);
}

/// Whether all that \p J reads and writes, but the records, is global memory.
static bool isMapped(const Job &J, RasterMemory &Memory) {
  if (!J.TakesPushed && J.Count != 0 && !Memory.range(J.List, 4ULL * J.Count))
    return false;
  for (unsigned Row = 0; Row != J.Height; ++Row)
    if ((J.usesOutput() && !outputRow(J, Memory, Row)) ||
        (J.IsLimited && !limitRow(J, Memory, Row)) ||
        (J.StartsLate && !fromRow(J, Memory, Row)) ||
        ((J.IsBackward || J.KeepsLast) && !lastRow(J, Memory, Row)) ||
        (J.IsBackward && !upstreamRow(J, Memory, Row)))
      return false;
  return (!J.mayHandOver() || Memory.range(J.TailRecord, J.tailBytes())) &&
         (!J.KeepsCounts || Memory.range(J.Last, CountsBytes));
}

/// The order of these checks is the order of docs/rasterizer.md#status-codes.
static uint32_t refusal(const Command &C, const Job &J, RasterMemory &Memory) {
  if (!isKnown(C, J))
    return VR_BAD_MODE;
  if (!isShape(J))
    return VR_BAD_SHAPE;
  const auto Cutoff = std::bit_cast<float>(C.Cutoff);
  if (!(Cutoff >= 0.0F && Cutoff < 1.0F))
    return VR_BAD_CUTOFF;
  if (J.TakesPushed ? C.PushOverflowed : J.Count > VR_MAX_COUNT)
    return VR_BAD_COUNT;
  if (J.TailShare > VR_TAIL_WHOLE ||
      (J.mayHandOver() && (J.TakesPushed || J.Drains || J.IsBackward ||
                           J.KeepsLast || !J.Units.isConic())))
    return VR_BAD_TAIL;
  if (!isAligned(J))
    return VR_MISALIGNED;
  return isMapped(J, Memory) ? VR_OK : VR_UNMAPPED;
}

Job checkCommand(const Command &C, RasterMemory &Memory) {
  Job J = decode(C);
  J.Refusal = refusal(C, J, Memory);
  return J;
}

} // namespace vorion::raster
