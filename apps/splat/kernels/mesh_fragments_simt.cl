// Draws a mesh's triangles that are not opaque by the cores alone. A group draws
// a tile, each work-item every sixteenth pixel.

#include "fragment.cl"
#include "local_view.cl"
#include "sample_triangle.cl"
#include "tile.h"

#define LANES 16

// The triangles of `records` are masked or blended.
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
    __global uint *counts, __global uint2 *layers) {
  __local splat_view view;
  take_view(&view, camera);
  const surface from = SURFACE_OF_ARGUMENTS;
  const uint width = view.size[0], height = view.size[1];
  const fragment_targets to = {visible, counts, layers, width * height};
  const uint tile = get_group_id(0);
  const uint x0 = tile % view.tiles[0] * TILE_SIZE;
  const uint y0 = tile / view.tiles[0] * TILE_HEIGHT;
  const uint2 range = ranges[tile];
  for (uint place = get_local_id(0); place < TILE_SIZE * TILE_HEIGHT;
       place += LANES) {
    const uint x = x0 + place % TILE_SIZE, y = y0 + place / TILE_SIZE;
    if (x >= width || y >= height)
      continue;
    const uint pixel = y * width + x;
    for (uint e = range.x; e < range.y; ++e) {
      const surface_sample s = sample_triangle(records, list[e], x, y, x0, y0);
      if (!s.is_covered || !(s.depth > as_float(visible[pixel].x)))
        continue;
      __global const splat_material *look = materials + material_of[s.triangle];
      const float4 color = surface_color(&view, &from, s.triangle, (float)x + 0.5f,
                                    (float)y + 0.5f);
      if (!is_drawn(look, color.w))
        continue;
      if (look->mode == MATERIAL_MASK)
        hide(&to, pixel, s.depth, s.triangle);
      else
        add_layer(&to, pixel, s.depth, s.triangle);
    }
  }
}
