// What a triangle of a mesh shows in a pixel (docs/meshes.md): colours of its
// vertices, a texture, light. Textures are filtered, and light is computed, in
// linear light; the result is as pictures show it.
#pragma once

// Rays are parallel (lens/Orthographic.cpp).
#pragma vorion choice effect USE_ORTHOGRAPHIC
// Triangles have textures (effects/Texture.cpp).
#pragma vorion choice effect USE_TEXTURE
// Bits of the fractions by which filters weight texels and levels
// (--filter-bits). Without it these are fp32.
#pragma vorion choice optional uint FILTER_BITS
// A light shines on them (effects/Light.cpp).
#pragma vorion choice effect USE_LIGHT

#include "layout.h"

// A mesh. Points are in the camera's axes.
typedef struct {
  __global const float4 *points;
  __global const uint *corners;
  __global const float4 *colors; // of vertices
#if USE_TEXTURE
  __global const float2 *coordinates; // of corners
  __global const uint *material_of;   // of triangles
  __global const splat_material *materials;
  __global const uint *texels;
  __global const float *linear; // of the 256 values of a channel
#endif
#if USE_LIGHT
  __global const float *normals; // of corners, in the world's axes; 0: none
  float3 light;                  // towards it, in the world's axes
#endif
} surface;

// A surface of a kernel's arguments, which have the names of its members.
#if USE_TEXTURE
#define TEXTURE_MEMBERS                                                        \
  .coordinates = coordinates, .material_of = material_of,                      \
  .materials = materials, .texels = texels, .linear = linear,
#else
#define TEXTURE_MEMBERS
#endif
#if USE_LIGHT
#define LIGHT_MEMBERS .normals = normals, .light = light.xyz,
#else
#define LIGHT_MEMBERS
#endif
#define SURFACE_OF_ARGUMENTS                                                   \
  {.points = points,                                                           \
   .corners = corners,                                                         \
   .colors = colors,                                                           \
   TEXTURE_MEMBERS LIGHT_MEMBERS}

// Where the ray of a pixel meets a triangle's plane: the shares of the second
// and third corner there, and how they change from pixel to pixel.
typedef struct {
  float u, v;
  float2 across, down;
} meeting;

// T. Moeller, B. Trumbore 1997. The shares are quotients of functions that are
// linear on the picture.
static meeting meet(__local const splat_view *view, float3 origin, float3 first,
                    float3 second, float px, float py) {
  const float2 at = (float2)((px - view->center[0]) / view->focal[0],
                             (py - view->center[1]) / view->focal[1]);
#if USE_ORTHOGRAPHIC
  const float3 ray = (float3)(0.0f, 0.0f, 1.0f);
  const float3 from = (float3)(at.x, at.y, 0.0f) - origin;
#else
  const float3 ray = (float3)(at.x, at.y, 1.0f);
  const float3 from = -origin;
#endif
  const float3 side = cross(ray, second);
  const float whole = dot(first, side);
  meeting m;
  m.u = dot(from, side) / whole;
  m.v = dot(ray, cross(from, first)) / whole;
#if USE_TEXTURE
  const float2 step =
      (float2)(1.0f / view->focal[0], 1.0f / view->focal[1]) / whole;
#if USE_ORTHOGRAPHIC
  m.across = step.x * (float2)(-second.y, first.y);
  m.down = step.y * (float2)(second.x, -first.x);
#else
  const float3 normal = cross(second, first), of_u = cross(second, from),
               of_v = cross(from, first);
  m.across = step.x * (float2)(of_u.x - m.u * normal.x,
                               of_v.x - m.v * normal.x);
  m.down = step.y * (float2)(of_u.y - m.u * normal.y,
                             of_v.y - m.v * normal.y);
#endif
#endif
  return m;
}

#if USE_TEXTURE || USE_LIGHT
// A channel as pictures show it in linear light, and back (sRGB, IEC
// 61966-2-1). Powers by exp2 and log2: their error of some 1e-6 of the value is
// far below a picture's steps, and powr takes several times as long.
static float3 power(float3 c, float exponent) {
  return exp2(exponent * log2(c));
}

static float3 to_linear(float3 c) {
  if (all(c == 1.0f)) // most vertices of textured triangles
    return c;
  return select(power((c + 0.055f) / 1.055f, 2.4f), c / 12.92f, c <= 0.04045f);
}

static float3 from_linear(float3 c) {
  return select(1.055f * power(c, 1.0f / 2.4f) - 0.055f, 12.92f * c,
                c <= 0.0031308f);
}
#endif

#if USE_TEXTURE
// A texture coordinate in the picture: 0 to 1.
static float folded(float at, uint wrap) {
  if (wrap == WRAP_REPEAT)
    return at - floor(at);
  if (wrap == WRAP_MIRROR) {
    const float twice = at - 2.0f * floor(0.5f * at);
    return twice > 1.0f ? 2.0f - twice : twice;
  }
  return clamp(at, 0.0f, 1.0f);
}

// The place of a texel that may be one beyond the border.
static int wrapped(int at, int size, uint wrap) {
  if (wrap == WRAP_REPEAT)
    return at < 0 ? size - 1 : at >= size ? 0 : at;
  return clamp(at, 0, size - 1);
}

static float4 texel(const surface *s, uint place) {
  const uint c = s->texels[place];
  return (float4)(s->linear[c & 255], s->linear[c >> 8 & 255],
                  s->linear[c >> 16 & 255], (float)(c >> 24) / 255.0f);
}

// A place between texels or levels, as the filters have it.
static float filter_place(float at) {
#ifdef FILTER_BITS
  return rint(at * (float)(1 << FILTER_BITS)) / (float)(1 << FILTER_BITS);
#else
  return at;
#endif
}

// The texture in one of its levels, `at` 0 to 1.
static float4 sample_level(const surface *s, __global const splat_material *m,
                           uint level, bool is_linear, float2 at) {
  const int width = max(m->size[0] >> level, 1u);
  const int height = max(m->size[1] >> level, 1u);
  const uint first = m->first[level];
  const float x = at.x * (float)width, y = at.y * (float)height;
  if (!is_linear)
    return texel(s, first + (uint)(min((int)y, height - 1) * width +
                                   min((int)x, width - 1)));
  const float px = filter_place(x - 0.5f), py = filter_place(y - 0.5f);
  const float left = floor(px), top = floor(py);
  const float fx = px - left, fy = py - top;
  const int x0 = wrapped((int)left, width, m->wrap[0]);
  const int x1 = wrapped((int)left + 1, width, m->wrap[0]);
  const uint y0 = first + (uint)(wrapped((int)top, height, m->wrap[1]) * width);
  const uint y1 =
      first + (uint)(wrapped((int)top + 1, height, m->wrap[1]) * width);
  return mix(mix(texel(s, y0 + x0), texel(s, y0 + x1), fx),
             mix(texel(s, y1 + x0), texel(s, y1 + x1), fx), fy);
}

// The texture at the coordinates `at`, which change by `across` and `down` from
// pixel to pixel (OpenGL ES 3.2, 8.14).
static float4 sample_texture(const surface *s, __global const splat_material *m,
                     float2 at, float2 across, float2 down) {
  const float2 size = (float2)((float)m->size[0], (float)m->size[1]);
  const float2 place =
      (float2)(folded(at.x, m->wrap[0]), folded(at.y, m->wrap[1]));
  const float longest =
      max(dot(across * size, across * size), dot(down * size, down * size));
  const float level = 0.5f * log2(longest);
  if (!(level > 0.0f))
    return sample_level(s, m, 0, m->filters & FILTER_LARGER, place);
  const bool is_linear = m->filters & FILTER_SMALLER;
  const float last = (float)(m->levels - 1);
  if (!(m->filters & FILTER_LEVELS))
    return sample_level(s, m, 0, is_linear, place);
  if (!(m->filters & FILTER_BETWEEN))
    return sample_level(s, m, (uint)min(ceil(level + 0.5f) - 1.0f, last),
                        is_linear, place);
  const float held = filter_place(min(level, last)), lower = floor(held);
  const float4 fine = sample_level(s, m, (uint)lower, is_linear, place);
  if (held == lower)
    return fine;
  return mix(fine, sample_level(s, m, (uint)lower + 1, is_linear, place),
             held - lower);
}
#endif

#if USE_LIGHT
// The share of light that comes from all directions.
#define AMBIENT 0.2f

// Light at a point of a triangle whose plane has the normal `plane` in the
// camera's axes, on the side that the camera sees: `from` is a vector from the
// camera to it.
static float light_on(__local const splat_view *view, const surface *s,
                      uint i, float u, float v, float3 plane, float3 from) {
  __local const float *w = view->rotation;
  const float sign = dot(plane, from) > 0.0f ? -1.0f : 1.0f;
  // The plane's normal in the world's axes.
  const float3 face =
      sign * normalize((float3)(w[0] * plane.x + w[3] * plane.y + w[6] * plane.z,
                                w[1] * plane.x + w[4] * plane.y + w[7] * plane.z,
                                w[2] * plane.x + w[5] * plane.y +
                                    w[8] * plane.z));
  const float3 own = (1.0f - u - v) * vload3(3 * i, s->normals) +
                     u * vload3(3 * i + 1, s->normals) +
                     v * vload3(3 * i + 2, s->normals);
  float3 normal = face;
  if (dot(own, own) > 0.0f)
    normal = normalize(dot(own, face) < 0.0f ? -own : own);
  return AMBIENT + (1.0f - AMBIENT) * max(dot(normal, s->light), 0.0f);
}
#endif

// The colour of triangle `i` in the pixel with centre (px, py), held within the
// triangle: a snapped edge may cover a pixel just beside it.
static float4 surface_color(__local const splat_view *view, const surface *s, uint i,
                       float px, float py) {
  const uint a = s->corners[3 * i], b = s->corners[3 * i + 1],
             c = s->corners[3 * i + 2];
  const float3 origin = s->points[a].xyz;
  const float3 first = s->points[b].xyz - origin,
               second = s->points[c].xyz - origin;
  const meeting m = meet(view, origin, first, second, px, py);
  const float u = clamp(m.u, 0.0f, 1.0f);
  const float v = clamp(m.v, 0.0f, 1.0f - u);
  const float w = 1.0f - u - v;
  float4 color = w * s->colors[a] + u * s->colors[b] + v * s->colors[c];
#if USE_TEXTURE || USE_LIGHT
  float3 linear = to_linear(color.xyz);
#if USE_TEXTURE
  __global const splat_material *look = s->materials + s->material_of[i];
  if (look->levels != 0) {
    const float2 t = s->coordinates[3 * i], by_u = s->coordinates[3 * i + 1] - t,
                 by_v = s->coordinates[3 * i + 2] - t;
    const float4 picture =
        sample_texture(s, look, t + u * by_u + v * by_v,
               m.across.x * by_u + m.across.y * by_v,
               m.down.x * by_u + m.down.y * by_v);
    linear *= picture.xyz;
    color.w *= picture.w;
  }
#endif
#if USE_LIGHT
#if USE_ORTHOGRAPHIC
  const float3 from = (float3)(0.0f, 0.0f, 1.0f);
#else
  const float3 from = origin;
#endif
  linear *= light_on(view, s, i, u, v, cross(first, second), from);
#endif
  color.xyz = from_linear(linear);
#endif
  return color;
}
