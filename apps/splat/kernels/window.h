// Where a tile's pixels are by the records that it blends. Those of a wide
// picture (effects/Windows.cpp) are of its windows, each with means from the
// window's first pixel, one window after the other, behind a splat_windows in
// the place of the first record.
#pragma once

// Records of windows (effects/Windows.cpp).
#pragma vorion choice effect USE_WINDOWS

#include "layout.h"
#include "record.h"

typedef struct {
  __global const splat_record *records;
  uint x, y; // of the tile's first pixel
} tile_place;

// Of the tile whose first pixel in the picture is (x, y).
static tile_place place_of_tile(__global const splat_record *records, uint x,
                                uint y) {
#if USE_WINDOWS
  const splat_windows w = *(__global const splat_windows *)records;
  const uint window = (y >> w.bits) * w.columns + (x >> w.bits);
  const uint rest = (1u << w.bits) - 1;
  return (tile_place){records + 1 + window * w.stride, x & rest, y & rest};
#else
  return (tile_place){records, x, y};
#endif
}
