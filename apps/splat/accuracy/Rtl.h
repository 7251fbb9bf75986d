/// The rasterizer in SystemVerilog (docs/rtl.md) on tiles of a view.
#pragma once

#include "accuracy/Sweep.h"

#include <functional>
#include <string_view>

namespace vorion::splat {

/// Results for a sample of tiles.
struct RtlRun {
  unsigned Tiles = 0;    ///< random sample
  unsigned AllTiles = 0; ///< total of the view
  double Seconds = 0;    ///< processor seconds for Tiles
  /// Error of the clock's cycles compared with the RTL: of all Tiles, and of
  /// the worst tile.
  double ErrorPercent = 0, WorstPercent = 0;
  unsigned WrongPixels = 0;
};

/// Builds the RTL with Verilator in \p P's folder, and simulates it on tiles of
/// \p View with its exponential unit "table". An Error names the missing
/// program or the failed step. \p Log is called at the start of slow steps.
Expected<RtlRun> runRtl(const SweepPlan &P, const Camera &View,
                        const std::function<void(std::string_view)> &Log);

} // namespace vorion::splat
