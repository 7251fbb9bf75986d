/// A command that a rasterizer or a pixel unit takes, its words read once.
#pragma once

#include "raster/Backward.h"
#include "raster/Command.h"
#include "raster/Datapath.h"
#include "raster/RasterMemory.h"
#include "raster/UnitTables.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace vorion::raster {

/// The row of ExpUnits with number \p Option of vr_options.exp; ExpUnitCount if
/// no unit has the number.
constexpr uint8_t expRowOf(uint32_t Option) {
  return static_cast<uint8_t>(
      std::ranges::find(ExpUnits, Option, &ExpUnit::Option) -
      std::begin(ExpUnits));
}

/// The row of FrontEnds with number \p Primitive of vr_mode.primitive;
/// std::size(FrontEnds) if there is none.
constexpr uint8_t frontEndRowOf(uint32_t Primitive) {
  return static_cast<uint8_t>(
      std::ranges::find(FrontEnds, Primitive, &FrontEnd::Primitive) -
      std::begin(FrontEnds));
}

/// The units of a lane that vr_options and vr_mode choose.
struct LaneUnits {
  uint8_t Exp = 0;      ///< row of ExpUnits
  uint8_t Blend = 0;    ///< vr_options.blend
  uint8_t FrontEnd = 0; ///< row of FrontEnds

  /// Whether what the front end covers is opaque: pixels have a depth and a
  /// primitive, and nothing is blended. Of one that does not exist, true.
  bool isOpaque() const {
    return FrontEnd >= std::size(FrontEnds) || FrontEnds[FrontEnd].IsOpaque;
  }
  /// Whether records are vx_gaussian.
  bool isConic() const {
    return FrontEnd < std::size(FrontEnds) &&
           FrontEnds[FrontEnd].Primitive == VR_PRIMITIVE_CONIC;
  }
};

/// What a command does with depths (VR_WORD_DEPTH).
struct DepthOptions {
  uint8_t Function = 0;
  bool Writes = false;
  bool Loads = false;     ///< the tile begins with what is at vr_output
  bool IsInteger = false; ///< depths are rounded before the test
  float Clear = 0;        ///< with which a tile begins that loads nothing
};

/// The bits of vr_mode that a vx_tail_range has.
inline constexpr uint32_t TailRangeModes =
    ModeLimited.put(1) | ModeFrom.put(1) | ModeKeepSaturated.put(1);

/// Words of the pixel buffer of a bank's row.
inline constexpr unsigned BankRowWords = 4;

/// Bytes that a command of mode "keep_counts" writes, and their alignment.
inline constexpr uint32_t CountsBytes = 2 * sizeof(uint32_t);

/// What a command asks for. A refused one has its fields too: it takes time,
/// and observers show it.
struct Job {
  uint32_t Refusal = VR_OK; ///< the status code if nothing may be done
  bool IsBackward = false;
  bool TakesPushed = false; ///< descriptors instead of a list
  bool Drains = false;      ///< to the agent, not to memory
  bool KeepsLast = false;
  bool KeepsCounts = false;
  bool HandsFragments = false; ///< and writes no pixels
  bool IsLimited = false;      ///< pixels have limits
  bool StartsLate = false;     ///< pixels have first entries
  bool LoadsPixels = false;    ///< and does not begin with empty ones
  bool KeepsSaturated = false; ///< in the signs of transmittances

  /// The tile, in pixels of the picture.
  uint16_t X = 0, Y = 0, Width = 0, Height = 0;

  uint32_t Gaussians = 0; ///< address of the records
  uint32_t List = 0;      ///< address of the first entry
  uint32_t Count = 0;     ///< entries
  uint32_t Output = 0, OutputPitch = 0;
  uint32_t Last = 0;       ///< address of the last contributors or the counts
  uint32_t Upstream = 0;   ///< address of the pixels' gradients
  uint32_t Limit = 0;      ///< address of the pixels' limits
  uint32_t LimitFirst = 0; ///< number that limits give the list's first entry
  uint32_t From = 0;       ///< address of the pixels' first entries

  uint32_t TailCount = 0, TailShare = 0; ///< see mayHandOver()
  uint32_t TailRecord = 0;               ///< address of the vx_tail

  LaneUnits Units;
  BlendOptions Blend{};
  BackwardOptions Backward;
  DepthOptions Depth;

  /// The front end; that of conics if the command was refused for it.
  const FrontEnd &frontEnd() const {
    return FrontEnds[Units.FrontEnd < std::size(FrontEnds) ? Units.FrontEnd
                                                           : 0];
  }
  /// Of a pixel at vr_output.
  uint32_t pixelBytes() const { return frontEnd().OutputBytes; }
  /// Words that the range of a pixel takes.
  unsigned rangeWords() const { return unsigned{IsLimited} + StartsLate; }
  /// Words that a pixel takes of the pixel buffer (docs/primitives.md).
  unsigned pixelWords() const {
    constexpr unsigned BackwardWords = 6;
    return IsBackward ? BackwardWords
                      : frontEnd().PixelWords + KeepsLast + rangeWords();
  }
  /// Places that the tile takes of the pixel buffer's VR_MAX_TILE^2.
  unsigned bufferPlaces() const {
    const unsigned Each = (pixelWords() + BankRowWords - 1) / BankRowWords;
    return unsigned{Width} * Height * Each;
  }
  /// Whether pixels at vr_output are read or written.
  bool usesOutput() const {
    return !Drains && (!HandsFragments || Depth.Loads);
  }
  /// Whether the tile begins with what is at vr_output.
  bool loadsOutput() const { return IsBackward || Depth.Loads || LoadsPixels; }
  /// Whether batches are handed over (Command::handsOver()).
  bool handsOver() const { return IsBackward || HandsFragments; }

  /// Whether the pixel unit may be asked to go on.
  bool mayHandOver() const { return TailCount != 0 || TailShare != 0; }
  /// Of the record of that.
  uint32_t tailBytes() const {
    return sizeof(Tail) + (hasTailRange() ? sizeof(TailRange) : 0);
  }
  bool hasTailRange() const { return rangeWords() != 0 || KeepsSaturated; }
};

/// Reads \p C, and makes all checks of docs/rasterizer.md#status-codes but
/// those of list entries.
Job checkCommand(const Command &C, RasterMemory &Memory);

} // namespace vorion::raster
