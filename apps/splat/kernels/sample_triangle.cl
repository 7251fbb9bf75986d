// The arithmetic of the rasterizer's front end of triangles on the cores
// (docs/primitives.md).
#pragma once

#include "depth_format.h"
#include "layout.h"

#include <vorion.h>

typedef struct {
  bool is_covered;
  float depth;
  uint triangle;
} surface_sample;

static long edge_at(__global const vx_triangle *t, uint k, uint x, uint y) {
  return (long)((ulong)(uint)t->c_high[k] << 32 | t->c_low[k]) +
         (long)t->a[k] * (long)x + (long)t->b[k] * (long)y;
}

// Triangle `number` of `records` in pixel (x, y) of the tile that begins at
// (x0, y0).
static surface_sample sample_triangle(__global const uint *records, uint number,
                                      uint x, uint y, uint x0, uint y0) {
  surface_sample s = {false, 0.0f, 0};
  __global const vx_triangle *t =
      (__global const vx_triangle *)records + (number & ~SPANS_TILES);
  const uint first = t->first, last = t->last;
  if ((x < (first & 0xffff)) | (x > (last & 0xffff)) | (y < first >> 16) |
      (y > last >> 16))
    return s;
  if ((edge_at(t, 0, x, y) | edge_at(t, 1, x, y) | edge_at(t, 2, x, y)) < 0)
    return s;
  // As the unit has it: at the tile's first pixel, then from there.
  const float corner =
      (t->depth +
       t->depth_step[0] * (float)((int)x0 - (int)(first & 0xffff))) +
      t->depth_step[1] * (float)((int)y0 - (int)(first >> 16));
  s.is_covered = true;
  s.depth = (corner + t->depth_step[0] * (float)(x - x0)) +
            t->depth_step[1] * (float)(y - y0);
#if DEPTH_IS_INTEGER
  s.depth = rint(s.depth);
#endif
  s.triangle = t->tag;
  return s;
}
