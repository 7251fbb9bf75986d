// A mesh of triangles beside the Gaussians (effects/Mesh.cpp, docs/meshes.md):
// from its vertices to records of the rasterizer's triangle front end, from the
// depths that those leave to the pixels' limits in the sorted lists, and from
// blended pixels to the picture. Another program draws the triangles
// (mesh_raster.cl or mesh_simt.cl).

// Rays are parallel (lens/Orthographic.cpp).
#pragma vorion choice effect USE_ORTHOGRAPHIC
// Sub-pixel bits of the corners, up to VX_SUBPIXEL_BITS (--subpixel-bits).
#pragma vorion choice optional uint SUBPIXEL_BITS
// Some triangles are not opaque, and drawn apart (effects/Mesh.cpp).
#pragma vorion choice effect USE_LAYERS

#define VIEW_SPACE __local // covariance.cl

#include "camera_depth.cl"
#include "covariance.cl"
#include "layout.h"
#include "local_view.cl"
#include "mesh_depth.cl"
#include "near.h"
#include "rectangle.cl"
#include "surface.cl"
#include "tile.h"

#include <vorion_triangles.h>

// Columns and rows between which triangles are cut, px: inside the guard band
// of vorion_triangles.h.
#define GUARD_LOW -65000.0f
#define GUARD_HIGH 130000.0f
// Of a triangle that is cut by the near plane and four sides.
#define MOST_CORNERS 8
#define CUTS 5

#ifndef SUBPIXEL_BITS
#define SUBPIXEL_BITS VX_SUBPIXEL_BITS
#endif

// Vertices in the camera's axes; their z is what orders Gaussians.
__kernel void mesh_points(__global const splat_view *camera,
                          __global const float *positions,
                          __global float4 *points, uint count) {
  __local splat_view view;
  take_view(&view, camera);
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const float px = positions[3 * i], py = positions[3 * i + 1],
              pz = positions[3 * i + 2];
  const float3 d = from_camera(&view, (float3)(px, py, pz));
  __local const float *w = view.rotation;
  points[i] = (float4)(w[0] * d.x + w[1] * d.y + w[2] * d.z,
                       w[3] * d.x + w[4] * d.y + w[5] * d.z,
                       camera_depth(&view, px, py, pz), 1.0f);
}

typedef struct {
  float x[MOST_CORNERS], y[MOST_CORNERS], z[MOST_CORNERS];
  uint count;
} polygon;

static void append(polygon *p, float x, float y, float z) {
  if (p->count == MOST_CORNERS)
    return;
  p->x[p->count] = x;
  p->y[p->count] = y;
  p->z[p->count] = z;
  ++p->count;
}

// How far a point is inside of a cut, up to a factor; a NaN is outside.
static float inside_of(uint cut, __local const splat_view *view, float x,
                       float y, float z) {
#if USE_ORTHOGRAPHIC
  const float w = 1.0f;
#else
  const float w = z;
#endif
  if (cut == 0)
    return z - NEAR_LIMIT;
  const bool across = cut < 3;
  const float at = (across ? view->focal[0] : view->focal[1]) * (across ? x : y);
  const float center = across ? view->center[0] : view->center[1];
  return cut % 2 == 1 ? at + (center - GUARD_LOW) * w
                      : (GUARD_HIGH - center) * w - at;
}

// The new corner is computed from the inner to the outer one, whoever asks: two
// triangles that share an edge get the same one.
static void cut_once(uint cut, __local const splat_view *view, polygon *p) {
  float inside[MOST_CORNERS];
  bool whole = true;
  for (uint i = 0; i < p->count; ++i) {
    inside[i] = inside_of(cut, view, p->x[i], p->y[i], p->z[i]);
    whole &= inside[i] >= 0.0f;
  }
  if (whole)
    return;
  polygon left;
  left.count = 0;
  for (uint i = 0; i < p->count; ++i) {
    const uint next = i + 1 == p->count ? 0 : i + 1;
    const bool here = inside[i] >= 0.0f, there = inside[next] >= 0.0f;
    if (here)
      append(&left, p->x[i], p->y[i], p->z[i]);
    if (here != there) {
      const uint from = here ? i : next, to = here ? next : i;
      const float part = inside[from] / (inside[from] - inside[to]);
      const float z = p->z[from] + part * (p->z[to] - p->z[from]);
      append(&left, p->x[from] + part * (p->x[to] - p->x[from]),
             p->y[from] + part * (p->y[to] - p->y[from]),
             cut == 0 ? NEAR_LIMIT : z);
    }
  }
  *p = left;
}

// What is left of triangle `i` in front of the camera.
static polygon polygon_of(__local const splat_view *view,
                          __global const float4 *points,
                          __global const uint *corners, uint i) {
  polygon p;
  p.count = 0;
  for (uint k = 0; k < 3; ++k) {
    const float4 at = points[corners[3 * i + k]];
    append(&p, at.x, at.y, at.z);
  }
  for (uint cut = 0; cut < CUTS && p.count >= 3; ++cut)
    cut_once(cut, view, &p);
  return p;
}

// In units of the set-up, 2^-VX_SUBPIXEL_BITS px.
static int snapped(float place) {
  return convert_int_rte(clamp(place, GUARD_LOW - 1.0f, GUARD_HIGH + 1.0f) *
                         (float)(1 << SUBPIXEL_BITS)) *
         (1 << (VX_SUBPIXEL_BITS - SUBPIXEL_BITS));
}

// The record of triangle `part` of the fan of `p`; 0 if no pixel is covered.
static int set_up(vx_triangle *out, __local const splat_view *view,
                  const polygon *p, uint part, uint tag) {
  int x[3], y[3];
  float depth[3];
  for (uint k = 0; k < 3; ++k) {
    const uint corner = k == 0 ? 0 : part + k;
    const float z = p->z[corner];
#if USE_ORTHOGRAPHIC
    const float across = p->x[corner], down = p->y[corner];
#else
    const float across = p->x[corner] / z, down = p->y[corner] / z;
#endif
    x[k] = snapped(view->focal[0] * across + view->center[0]);
    y[k] = snapped(view->focal[1] * down + view->center[1]);
    depth[k] = flip_depth(z);
  }
  return vx_triangle_setup(out, x, y, depth, tag, view->size[0],
                           view->size[1]);
}

// The triangles to draw of each of the mesh's; with layers, of those of one
// `mode`.
__kernel void mesh_count(__global const splat_view *camera,
                         __global const float4 *points,
                         __global const uint *corners, __global uint *counts,
#if USE_LAYERS
                         __global const uint *material_of,
                         __global const splat_material *materials, uint mode,
#endif
                         uint triangles) {
  __local splat_view view;
  take_view(&view, camera);
  const uint i = get_global_id(0);
  if (i >= triangles)
    return;
#if USE_LAYERS
  if (materials[material_of[i]].mode != mode) {
    counts[i] = 0;
    return;
  }
#endif
  const polygon p = polygon_of(&view, points, corners, i);
  uint count = 0;
  vx_triangle unused;
  for (uint part = 0; part + 2 < p.count; ++part)
    count += set_up(&unused, &view, &p, part, i);
  counts[i] = count;
}

// Their records, in the mesh's order, from place firsts[i] on; the tiles of
// their boxes as project leaves those of Gaussians, of which there are `stride`;
// and their numbers.
__kernel void mesh_setup(__global const splat_view *camera,
                         __global const float4 *points,
                         __global const uint *corners,
                         __global const uint *firsts,
                         __global uint *records, __global uint *rectangles,
                         __global uint *order, uint stride,
#if USE_LAYERS
                         __global const uint *material_of,
                         __global const splat_material *materials, uint mode,
#endif
                         uint triangles) {
  __local splat_view view;
  take_view(&view, camera);
  const uint i = get_global_id(0);
  if (i >= triangles)
    return;
#if USE_LAYERS
  if (materials[material_of[i]].mode != mode)
    return;
#endif
  const polygon p = polygon_of(&view, points, corners, i);
  uint place = firsts[i];
  for (uint part = 0; part + 2 < p.count; ++part) {
    vx_triangle t;
    if (!set_up(&t, &view, &p, part, i))
      continue;
    ((__global vx_triangle *)records)[place] = t;
    const uint2 r = make_rectangle(
        (t.first & 0xffff) / TILE_SIZE, (t.first >> 16) / TILE_HEIGHT,
        (t.last & 0xffff) / TILE_SIZE + 1, (t.last >> 16) / TILE_HEIGHT + 1);
    rectangles[place] = r.x;
    rectangles[stride + place] = r.y;
    order[place] = place;
    ++place;
  }
}

// Of each pixel, how many entries of its tile's list are in front of the mesh:
// those whose depth is less in the bits that order them. `visible` has a
// vx_visibility a pixel.
__kernel void mesh_limits(__global const uint2 *visible,
                          __global const uint *depths,
                          __global const uint *list,
                          __global const uint2 *ranges, __global uint *limits,
                          uint width, uint count, uint tiles_x, uint shift) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const uint2 seen = visible[i];
  if (seen.y == VR_NO_PRIMITIVE) {
    limits[i] = ~0u;
    return;
  }
  const uint2 range = ranges[i / width / TILE_HEIGHT * tiles_x +
                             i % width / TILE_SIZE];
  limits[i] = entries_before(depths, list, range, as_float(seen.x), shift);
}

// From (r, g, b, transmittance) to the picture: the mesh, or the background,
// shows through what is left, and the fourth channel becomes alpha.
__kernel void mesh_resolve(__global const splat_view *camera,
                           __global const float4 *points,
                           __global const uint *corners,
                           __global const float4 *colors,
#if USE_TEXTURE
                           __global const float2 *coordinates,
                           __global const uint *material_of,
                           __global const splat_material *materials,
                           __global const uint *texels,
                           __global const float *linear,
#endif
#if USE_LIGHT
                           __global const float *normals, float4 light,
#endif
                           __global const uint2 *visible,
                           __global const float4 *pixels,
                           __global float4 *picture, uint count, float red,
                           float green, float blue) {
  __local splat_view view;
  take_view(&view, camera);
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const float4 own = pixels[i];
  const uint triangle = visible[i].y;
  float3 behind = (float3)(red, green, blue);
  float alpha = 1.0f - own.w;
  if (triangle != VR_NO_PRIMITIVE) {
    const uint width = view.size[0];
    const surface from = SURFACE_OF_ARGUMENTS;
    behind = surface_color(&view, &from, triangle, (float)(i % width) + 0.5f,
                      (float)(i / width) + 0.5f)
                 .xyz;
    alpha = 1.0f;
  }
  picture[i] = (float4)(own.xyz + own.w * behind, alpha);
}
