// Depths of a mesh: those of its planes, and their places among Gaussians.
#pragma once

// Rays are parallel (lens/Orthographic.cpp).
#pragma vorion choice effect USE_ORTHOGRAPHIC

#include "depth_format.h"
#include "layout.h"

// From z to the depth of the triangles' planes, which is linear on the picture
// and larger where it is nearer; and back, by the same formula.
static float flip_depth(float depth) {
#if USE_ORTHOGRAPHIC
  return -depth;
#else
  return DEPTH_SCALE / depth;
#endif
}

// How many entries of a tile's list, `range` of `list`, are in front of a
// surface whose plane has the depth `depth`: those whose own is less in the bits
// that order them.
static uint entries_before(__global const uint *depths,
                           __global const uint *list, uint2 range, float depth,
                           uint shift) {
  const uint key = as_uint(flip_depth(depth)) >> shift;
  uint low = range.x, high = range.y;
  while (low < high) {
    const uint middle = (low + high) / 2;
    if (depths[list[middle] & ~SPANS_TILES] >> shift < key)
      low = middle + 1;
    else
      high = middle;
  }
  return low - range.x;
}
