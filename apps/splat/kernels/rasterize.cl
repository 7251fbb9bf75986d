// Blending by the rasterizer: one group a tile hands the tile's list to the
// Raster Agent of its core and waits (docs/rasterizer.md). `options` is what
// vr_options takes; a tile's status code goes to `statuses`.
#include <vorion_raster.h>

_Static_assert(sizeof(splat_gaussian) == sizeof(vx_gaussian),
               "kernels/layout.h and docs/abi.md disagree");

__kernel __attribute__((reqd_work_group_size(16, 1, 1))) void
rasterize(__global const splat_gaussian *records, __global const uint *list,
          __global const uint2 *ranges, __global float4 *pixels,
          __global uint *statuses, uint width, uint height, float cutoff,
          uint options) {
  const uint tile = get_group_id(1) * get_num_groups(0) + get_group_id(0);
  const uint x = get_group_id(0) * TILE_SIZE;
  const uint y = get_group_id(1) * TILE_SIZE;
  const uint2 range = ranges[tile];
  vx_raster_setup((uint)records, cutoff, options, width * sizeof(float4));
  vx_raster_render((uint)(list + range.x), range.y - range.x, x, y,
                   min((uint)TILE_SIZE, width - x),
                   min((uint)TILE_SIZE, height - y),
                   (uint)(pixels + y * width + x));
  const uint status = vr_wait();
  if (get_local_id(0) == 0)
    statuses[tile] = status;
}
