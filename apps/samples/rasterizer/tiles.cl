/* Draws a picture with the rasterizer, one tile a group. */
#include <vorion_raster.h>

#define TILE 64u /* the largest tile there is, in pixels */

/* `records` are the Gaussians, `list` their numbers from front to back, and
   `pixels` the picture: red, green, blue, and what is left of the light behind.
   A group writes the status of its tile, 0 if all is well. */
kernel __attribute__((reqd_work_group_size(16, 1, 1))) void
draw(global const vx_gaussian *records, global const uint *list, uint count,
     uint width, uint height, global float4 *pixels, global uint *statuses) {
  const uint tiles_x = (width + TILE - 1) / TILE;
  const uint tile = get_group_id(0);
  const uint x = tile % tiles_x * TILE, y = tile / tiles_x * TILE;

  /* What all tiles have in common. */
  vx_raster_setup((uint)records, 1e-4f, 0, width * sizeof(float4));
  /* This tile. The rasterizer begins, and the core goes on at once. */
  vx_raster_render((uint)list, count, x, y, min(TILE, width - x),
                   min(TILE, height - y), (uint)(pixels + y * width + x));
  /* Only after this may anybody read the pixels. */
  const uint status = vr_wait();
  if (get_local_id(0) == 0)
    statuses[tile] = status;
}
