// Draws a mesh's triangles by the cores alone: depth and triangle of each
// pixel. A group draws a tile, each work-item every sixteenth pixel.

#include "sample_triangle.cl"
#include "tile.h"

#define LANES 16

__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
mesh_visibility(__global const uint *records, __global const uint *list,
                __global const uint2 *ranges, __global uint2 *visible,
                uint width, uint height, uint tiles_x) {
  const uint tile = get_group_id(0);
  const uint x0 = tile % tiles_x * TILE_SIZE;
  const uint y0 = tile / tiles_x * TILE_HEIGHT;
  const uint2 range = ranges[tile];
  for (uint place = get_local_id(0); place < TILE_SIZE * TILE_HEIGHT;
       place += LANES) {
    const uint x = x0 + place % TILE_SIZE, y = y0 + place / TILE_SIZE;
    if (x >= width || y >= height)
      continue;
    float nearest = -INFINITY;
    uint triangle = VR_NO_PRIMITIVE;
    for (uint e = range.x; e < range.y; ++e) {
      const surface_sample s = sample_triangle(records, list[e], x, y, x0, y0);
      if (s.is_covered && s.depth > nearest) {
        nearest = s.depth;
        triangle = s.triangle;
      }
    }
    visible[y * width + x] = (uint2)(as_uint(nearest), triangle);
  }
}
