/// What goes through the lanes of a rasterizer: how long boxes of pixels take,
/// and when the next may begin.
#pragma once

#include "raster/UnitTables.h"
#include "raster/WorkLog.h"
#include "timing/raster/DispatchTable.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace vorion::isasim {

/// What the lanes and the pixel buffer of a rasterizer did, for models of
/// energy. What was blended counts when its command is taken.
struct LaneWork {
  std::array<uint64_t, raster::ExpUnitCount> Evaluated{};
  std::array<uint64_t, raster::BlendUnitCount> Blended{};
  uint64_t Gradients = 0;    ///< of pixels, in the backward mode
  uint64_t RayGradients = 0; ///< likewise, where records are of rays
  uint64_t LowPassed = 0; ///< pixels that lanes got with the low pass of rays
  uint64_t SurfelGradients = 0; ///< of RayGradients those with it
  /// Pixels that lanes got of other primitives than conics, by row of
  /// FrontEnds, and those of opaque ones that were covered and in front.
  std::array<uint64_t, std::size(raster::FrontEnds)> Covered{};
  uint64_t Passed = 0;
  uint64_t Moved = 0;      ///< pixels cleared, loaded or stored with their tile
  uint64_t RangeWords = 0; ///< of pixels' ranges, loaded with their tile
  uint64_t BlockRows = 0;  ///< of boxes, where blocks of them are tested

  LaneWork &operator+=(const LaneWork &Other);
  uint64_t allBlended() const;
  uint64_t allCovered() const;
};

class RasterLanes {
public:
  explicit RasterLanes(const RasterTiming &Params);

  /// What the box of a Gaussian takes of dispatch.
  struct Passage {
    unsigned Cycles = 0;
    unsigned Slots = 0;     ///< pixels that lanes get
    unsigned BlockRows = 0; ///< that are tested
  };
  /// Of a box that is not empty. In the backward mode a pixel takes a pair of
  /// lanes.
  Passage passageOf(const raster::GaussianWork &G, bool IsBackward);
  /// The earliest start, from \p Earliest on, of a box that takes \p Cycles: no
  /// pixel is read before an earlier box has updated it.
  uint64_t safeAt(const raster::GaussianWork &G, unsigned Cycles,
                  uint64_t Earliest) const;
  /// The box begins at \p Start and takes \p Cycles.
  void enter(const raster::GaussianWork &G, uint64_t Start, unsigned Cycles);
  /// All that was in them is done.
  void clear() { Inside = {}; }

private:
  /// A Gaussian whose pixels may still be in the lanes.
  struct Dispatched {
    raster::GaussianWork What{};
    uint64_t Start = 0;
    unsigned Cycles = 0;
  };
  unsigned cyclesByBlocks(const raster::GaussianWork &G, unsigned Rows) const;

  const RasterTiming Timing;
  DispatchTable Table;
  DispatchTable PairTable; ///< of pairs of lanes, for the backward mode
  static constexpr size_t Recent = 8;
  std::array<Dispatched, Recent> Inside{};
  size_t Next = 0; ///< place in Inside
};

} // namespace vorion::isasim
