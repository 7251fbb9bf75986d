// Transparent surfaces between Gaussians (effects/Mesh.cpp): a pixel's layers
// in the order of their depths, their places in the sorted list, and their
// blend.

#include "local_view.cl"
#include "mesh_depth.cl"
#include "surface.cl"
#include "tile.h"

__kernel void mesh_clear_layers(__global uint *layer_counts,
                                __global uint *tile_layers, uint count,
                                uint tiles) {
  const uint i = get_global_id(0);
  if (i < count)
    layer_counts[i] = 0;
  if (i <= tiles)
    tile_layers[i] = 0;
}

// Sorts the layers of each pixel, the nearest first, and of equal depths the
// mesh's first triangle. `limits`, the ends of the pixels' ranges, get a plane
// for each range: of range k the end is the place of layer k in the list, and
// what the first plane has where there is no layer k. `tile_layers` are the most
// layers that a pixel of each tile has; behind them is the most of the picture,
// which may be too many.
__kernel void mesh_sort_layers(__global uint2 *layers,
                               __global const uint *layer_counts,
                               __global const uint *depths,
                               __global const uint *list,
                               __global const uint2 *ranges,
                               __global uint *limits,
                               __global uint *tile_layers, uint width,
                               uint count, uint tiles_x, uint tiles,
                               uint shift) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const uint all = layer_counts[i];
  const uint own = min(all, (uint)MOST_LAYERS);
  const uint end = limits[i];
  uint2 sorted[MOST_LAYERS];
  for (uint k = 0; k < own; ++k) {
    const uint2 next = layers[k * count + i];
    const float depth = as_float(next.x);
    uint place = k;
    for (; place != 0; --place) {
      const uint2 before = sorted[place - 1];
      if (as_float(before.x) > depth ||
          (as_float(before.x) == depth && before.y < next.y))
        break;
      sorted[place] = before;
    }
    sorted[place] = next;
  }
  const uint tile = i / width / TILE_HEIGHT * tiles_x + i % width / TILE_SIZE;
  const uint2 range = ranges[tile];
  for (uint k = 0; k < own; ++k) {
    layers[k * count + i] = sorted[k];
    limits[k * count + i] = min(
        entries_before(depths, list, range, as_float(sorted[k].x), shift), end);
  }
  for (uint k = own; k <= MOST_LAYERS; ++k)
    limits[k * count + i] = end;
  if (own != 0) {
    atomic_max(tile_layers + tile, own);
    atomic_max(tile_layers + tiles, all);
  }
}

// Blends layer `layer` of each pixel that has one, behind all that its ranges up
// to that have left. A layer saturates no pixel.
__kernel void mesh_compose(__global const splat_view *camera, __global const float4 *points,
                           __global const uint *corners, __global const float4 *colors,
#if USE_TEXTURE
                           __global const float2 *coordinates,
                           __global const uint *material_of,
                           __global const splat_material *materials,
                           __global const uint *texels, __global const float *linear,
#endif
#if USE_LIGHT
                           __global const float *normals, float4 light,
#endif
                           __global const uint2 *layers,
                           __global const uint *layer_counts,
                           __global float4 *pixels, uint count, uint layer) {
  __local splat_view view;
  take_view(&view, camera);
  const uint i = get_global_id(0);
  if (i >= count || layer >= layer_counts[i])
    return;
  const surface from = SURFACE_OF_ARGUMENTS;
  const uint width = view.size[0];
  const float4 color =
      surface_color(&view, &from, layers[layer * count + i].y,
               (float)(i % width) + 0.5f, (float)(i / width) + 0.5f);
  const float4 own = pixels[i];
  // Its sign says whether Gaussians have saturated the pixel.
  const float front = fabs(own.w);
  const float weight = color.w * front;
  pixels[i] = (float4)(own.xyz + weight * color.xyz,
                       copysign(front * (1.0f - color.w), own.w));
}
