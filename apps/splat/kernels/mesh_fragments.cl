// Draws a mesh's triangles that are not opaque by the rasterizers, which hand
// their fragments over (docs/primitives.md#output). One group a core.

#include "deal.cl"
#include "depth_format.h"
#include "fragment.cl"
#include "local_view.cl"
#include "tile.h"

#include <vorion_raster.h>

#define LANES 16

// The triangles of `records` are masked or blended. Fragments that opaque
// surfaces hide are not handed over.
__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void mesh_fragments(
    __global const splat_view *camera, __global const float4 *points,
    __global const uint *corners, __global const float4 *colors,
    __global const uint *material_of, __global const splat_material *materials,
#if USE_TEXTURE
    __global const float2 *coordinates, __global const uint *texels,
    __global const float *linear,
#endif
#if USE_LIGHT
    __global const float *normals, float4 light,
#endif
    __global const uint *records, __global const uint *list,
    __global const uint2 *ranges, __global uint2 *visible,
    __global uint *counts, __global uint2 *layers, __global uint *statuses,
    uint tiles) {
  __local splat_view view;
  take_view(&view, camera);
  const surface from = SURFACE_OF_ARGUMENTS;
  const uint width = view.size[0], height = view.size[1];
  const fragment_targets to = {visible, counts, layers, width * height};
  vx_raster_setup((uint)records, 0.0f, 0, width * (uint)sizeof(uint2));
  vr_tail_count_set(0);
  vr_tail_share_set(0);
  vx_raster_triangles(VR_DEPTH_GREATER << VR_DEPTH_FUNCTION_SHIFT |
                          1 << VR_DEPTH_LOAD_SHIFT |
                          DEPTH_IS_INTEGER << VR_DEPTH_INTEGER_SHIFT,
                      0.0f, 1);
  const uint lane = get_local_id(0);
  for (deal d = first_job(); d.job < tiles; d = next_job(d)) {
    const uint2 range = ranges[d.job];
    if (range.x == range.y)
      continue;
    const uint x = d.job % view.tiles[0] * TILE_SIZE;
    const uint y = d.job / view.tiles[0] * TILE_HEIGHT;
    vx_raster_render((uint)list + range.x * (uint)sizeof(uint),
                     range.y - range.x, x, y, min((uint)TILE_SIZE, width - x),
                     min((uint)TILE_HEIGHT, height - y),
                     (uint)visible + (y * width + x) * (uint)sizeof(uint2));
    uint next;
    while ((next = vr_grad_next()) != 0) {
      const uint fragments = next & VR_GRAD_NEXT_COUNT_MASK;
      vr_index_set(VR_ITEM_PRIMITIVE);
      const uint triangle = vr_item();
      vr_index_set(VR_ITEM_PIXEL);
      const uint place = vr_item();
      vr_index_set(VR_ITEM_DEPTH);
      const float depth = as_float(vr_item());
      const uint px = place & 0xffff, py = place >> 16;
      const uint pixel = py * width + px;
      bool is_masked = false;
      if (lane < fragments) {
        __global const splat_material *look = materials + material_of[triangle];
        if (is_drawn(look, surface_color(&view, &from, triangle, (float)px + 0.5f,
                                    (float)py + 0.5f)
                               .w)) {
          is_masked = look->mode == MATERIAL_MASK;
          if (!is_masked)
            add_layer(&to, pixel, depth, triangle);
        }
      }
      // A batch may have a pixel several times: one after the other.
      for (uint l = 0; l < fragments; ++l)
        if (lane == l && is_masked)
          hide(&to, pixel, depth, triangle);
    }
  }
  const uint status = vr_wait();
  if (lane == 0)
    statuses[vx_core_id()] = status;
}
