/// What one Gaussian cost in one tile, in either direction.
#pragma once

#include <cstdint>

namespace vorion::raster {

struct BoxWork {
  /// Pixels of the box (forward: lane slots; backward: slots of pairs of
  /// lanes); 0 if the box misses the tile's pixels.
  uint32_t Fragments;
  uint32_t Blends; ///< pixels that were blended, or gave a gradient
  bool Clipped;    ///< the box misses the tile
  /// The box cut to the tile, in its pixels; 0 if it misses.
  uint8_t X, Y, Width, Height;
};

} // namespace vorion::raster
