/// The work of rasterizers for each tile, as the device reports it.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vorion::splat {

/// The work of a tile, summed over its commands (one for each depth segment).
struct TileWork {
  int X = 0, Y = 0, Width = 0, Height = 0; ///< in pixels of the picture
  uint64_t List = 0;                       ///< entries
  uint64_t Blends = 0; ///< into pixels, including those of the pixel unit
  uint64_t Cycles = 0; ///< of the rasterizer
  uint64_t PixelUnitCycles = 0;
  uint64_t Pixels = 0;    ///< of all commands
  uint64_t Saturated = 0; ///< of these
};

/// The tiles of a picture.
struct DrawnTiles {
  std::vector<TileWork> Tiles; ///< in rows
  std::string On; ///< the machine and clock (ClockedMachine.h); or empty
};

/// Sums the records that the device wrote (VORION_TILES, docs/debugging.md).
/// Error: a malformed line.
Expected<DrawnTiles> readTileWork(const std::string &File);

} // namespace vorion::splat
