/// How a rasterizer writes a tile to memory: a line a cycle, then what follows
/// its pixels.
#pragma once

#include "raster/WorkLog.h"
#include "timing/memory/MemorySystem.h"
#include "timing/raster/GaussianFetch.h"

#include <cstdint>

namespace vorion::isasim {

class TileStore {
public:
  TileStore(const TimingConfig &Params, MemoryPort Port);

  /// How much of a tile has been asked to be written.
  struct Place {
    unsigned Row = 0;
    uint32_t Byte = 0; ///< of the row
  };
  /// Asks for the line at \p Next of the tile of \p J, as of the set \p Set of
  /// \p Fetch, and goes on behind it; returns its pixels.
  static uint32_t writeLine(MemorySystem &Memory, GaussianFetch &Fetch,
                            const raster::Job &J, Place &Next, unsigned Set);
  /// When writing the tile of \p J can go on: the slice takes a line a cycle,
  /// or holds the rasterizer up. Not before \p Earliest; Turn::Never if that is
  /// not known yet. \p Next is behind the line that was written last.
  uint64_t goesOnAt(const GaussianFetch &Fetch, unsigned Set, uint64_t Earliest,
                    const raster::Job &J, const Place &Next) const;
  /// What follows a tile's pixels: rows of last contributors, the pixel unit's
  /// record, a line a cycle from \p Then on. Returns the end.
  uint64_t writeRest(MemorySystem &Memory, const raster::CommandWork &Of,
                     uint64_t Then) const;

private:
  const uint32_t PortCycles;
  const uint32_t WriteCycles; ///< MemorySystem::writeCycles()
  const MemoryPort Port;
};

} // namespace vorion::isasim
