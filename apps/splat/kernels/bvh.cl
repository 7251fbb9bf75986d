// A tree of boxes over the Gaussians that rays may meet: in the order of Morton
// codes, each box that of four consecutive ones of the level below. Which boxes
// are together follows from the order alone, so nothing depends on who comes
// first (layout.h, splat_tree).

#include "layout.h"

// Beyond every ray: no part of the tree.
#define NOWHERE 0x1.fffffep127f

// The 10 bits of `cell`, two places apart.
static uint spread_bits(uint cell) {
  cell = (cell | cell << 16) & 0x030000ffu;
  cell = (cell | cell << 8) & 0x0300f00fu;
  cell = (cell | cell << 4) & 0x030c30c3u;
  return (cell | cell << 2) & 0x09249249u;
}

// Cells of a grid over all space, in which the middle one of the picture's
// Gaussians is halfway: outliers do not take the others' cells.
static uint cell_of(float x, float distance) {
  const float place = x / (fabs(x) + distance);
  return min((uint)(512.0f * (place + 1.0f)), 1023u);
}

// Codes in place of the keys of Gaussians that are not culled. The cells are
// along the camera's axes, of which the way ahead counts most: those of a node
// that are in front of the others come first, so that a ray that takes them in
// their order soon knows what is too far away.
__kernel void bvh_codes(__constant const splat_view *view,
                        __global const splat_traced *shapes,
                        __global uint *keys, uint count, float distance) {
  const uint i = get_global_id(0);
  if (i >= count || keys[i] >= CULLED)
    return;
  uint code = 0;
#pragma unroll
  for (int axis = 0; axis < 3; ++axis) {
    float place = 0.0f;
#pragma unroll
    for (int k = 0; k < 3; ++k)
      place += view->rotation[3 * axis + k] * shapes[i].mean[k];
    code |= spread_bits(cell_of(place, distance)) << axis;
  }
  keys[i] = code;
}

// Boxes in the order of codes, and empty ones up to a whole parent. `leaves`: of
// each Gaussian.
__kernel void bvh_leaves(__global const uint *order,
                         __global const float *boxes, __global float *nodes,
                         __global uint *leaves, splat_tree tree) {
  const uint i = get_global_id(0);
  if (i >= (tree.count + 3) / 4 * 4)
    return;
  __global float *to = nodes + BOX_WORDS * (tree.leaves - tree.gap + i);
  const uint from = i < tree.count ? order[i] : 0;
  if (i < tree.count)
    leaves[from] = i;
#pragma unroll
  for (uint k = 0; k < BOX_WORDS; ++k)
    to[k] = i < tree.count ? boxes[BOX_WORDS * from + k] : NOWHERE;
}

// The level whose first node is `first`, from the one below, in which the first
// `below` boxes are there.
__kernel void bvh_level(__global float *nodes, uint first, uint below,
                        splat_tree tree) {
  const uint i = get_global_id(0);
  if (i >= first)
    return;
  float box[BOX_WORDS];
#pragma unroll
  for (uint k = 0; k < BOX_WORDS; ++k)
    box[k] = NOWHERE;
  if (4 * i < below) {
    const uint child = 4 * (first + i);
    __global const float *from =
        nodes + BOX_WORDS * (child - (child >= tree.leaves ? tree.gap : 0));
    for (uint c = 0; c < 4 && 4 * i + c < below; ++c) {
#pragma unroll
      for (uint k = 0; k < 3; ++k) {
        const float low = from[BOX_WORDS * c + BOX_LOW + k];
        const float high = from[BOX_WORDS * c + BOX_HIGH + k];
        box[BOX_LOW + k] = c == 0 ? low : fmin(box[BOX_LOW + k], low);
        box[BOX_HIGH + k] = c == 0 ? high : fmax(box[BOX_HIGH + k], high);
      }
    }
  }
  __global float *to = nodes + BOX_WORDS * (first + i);
#pragma unroll
  for (uint k = 0; k < BOX_WORDS; ++k)
    to[k] = box[k];
}
