// Draws a mesh's triangles by the rasterizers: depth and triangle of each pixel
// (docs/primitives.md). One group a core.

#include "deal.cl"
#include "depth_format.h"
#include "tile.h"

#include <vorion_raster.h>

// `visible` has a vx_visibility a pixel. A larger depth is nearer, and of equal
// ones the mesh's first triangle stays.
__kernel __attribute__((reqd_work_group_size(16, 1, 1))) void
mesh_visibility(__global const uint *records, __global const uint *list,
                __global const uint2 *ranges, __global uint2 *visible,
                __global uint *statuses, uint width, uint height, uint tiles_x,
                uint tiles) {
  vx_raster_setup((uint)records, 0.0f, 0, width * (uint)sizeof(uint2));
  vr_tail_count_set(0);
  vr_tail_share_set(0);
  vx_raster_triangles(VR_DEPTH_GREATER << VR_DEPTH_FUNCTION_SHIFT |
                          1 << VR_DEPTH_WRITE_SHIFT |
                          DEPTH_IS_INTEGER << VR_DEPTH_INTEGER_SHIFT,
                      -INFINITY, 0);
  for (deal d = first_job(); d.job < tiles; d = next_job(d)) {
    const uint2 range = ranges[d.job];
    const uint x = d.job % tiles_x * TILE_SIZE;
    const uint y = d.job / tiles_x * TILE_HEIGHT;
    vx_raster_render((uint)list + range.x * (uint)sizeof(uint),
                     range.y - range.x, x, y, min((uint)TILE_SIZE, width - x),
                     min((uint)TILE_HEIGHT, height - y),
                     (uint)visible + (y * width + x) * (uint)sizeof(uint2));
  }
  const uint status = vr_wait();
  if (get_local_id(0) == 0)
    statuses[vx_core_id()] = status;
}
