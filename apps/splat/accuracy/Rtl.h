/// The rasterizer in SystemVerilog (docs/rtl.md) on tiles of a view.
#pragma once

#include "accuracy/Sweep.h"

#include <functional>
#include <string_view>

namespace vorion::splat {

/// How it fared on some tiles.
struct RtlRun {
  unsigned Tiles = 0;    ///< drawn at random
  unsigned AllTiles = 0; ///< of the view
  double Seconds = 0;    ///< of the host's processors, for Tiles
  /// Of the clock's cycles against the RTL's: of all Tiles, and of the worst.
  double ErrorPercent = 0, WorstPercent = 0;
  unsigned WrongPixels = 0;
};

/// Builds it with Verilator in \p P's folder, and runs it on tiles of \p View,
/// with the exponential unit "table", which is the one that it has. An Error
/// says what is missing here, or what went wrong. \p Log gets a line for what
/// takes long.
Expected<RtlRun> runRtl(const SweepPlan &P, const Camera &View,
                        const std::function<void(std::string_view)> &Log);

} // namespace vorion::splat
