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

/// The units of a lane that vr_options chooses.
struct LaneUnits {
  uint8_t Exp = 0;   ///< row of ExpUnits
  uint8_t Blend = 0; ///< vr_options.blend
};

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

  /// The tile, in pixels of the picture.
  uint16_t X = 0, Y = 0, Width = 0, Height = 0;

  uint32_t Gaussians = 0; ///< address of the records
  uint32_t List = 0;      ///< address of the first entry
  uint32_t Count = 0;     ///< entries
  uint32_t Output = 0, OutputPitch = 0;
  uint32_t Last = 0;     ///< address of the last contributors or the counts
  uint32_t Upstream = 0; ///< address of the pixels' gradients

  uint32_t TailCount = 0, TailShare = 0; ///< see mayHandOver()
  uint32_t TailRecord = 0;               ///< address of the vx_tail

  LaneUnits Units;
  BlendOptions Blend{};
  BackwardOptions Backward;

  /// Whether the pixel unit may be asked to go on.
  bool mayHandOver() const { return TailCount != 0 || TailShare != 0; }
};

/// Reads \p C, and makes all checks of docs/rasterizer.md#status-codes but
/// those of list entries.
Job checkCommand(const Command &C, RasterMemory &Memory);

} // namespace vorion::raster
