// What the rays of pixels need of a Gaussian (docs/primitives.md, "Rays"), in
// place of its footprint. Nothing is divided by a scale: with m from the camera
// to the mean, e_k the axes and s_k the scales, s_k e_k x m and the products of
// the other two scales times e_k . m say all, of a disc, too.
#pragma once

// Gaussians of several tiles are marked (effects/IntersectTags.cpp).
#pragma vorion choice effect USE_INTERSECT_TAGS

#include "activate.cl"
#include "covariance.cl"
#include "crop.cl"
#include "layout.h"
#include "lens_model.cl"
#include "record.h"
#include "rectangle.cl"
#include "support.cl"
#include "tile.h"

// As the sum of two floats, how far beside the ray through the picture's middle
// a Gaussian's centre is, px.
static float2 pixels_beside(VIEW_SPACE const splat_view *view,
                            VIEW_SPACE const splat_crop *crop, int axis,
                            float3 p, float z) {
  const float2 beside = beside_ray2(view, crop, axis, p.x, p.y, p.z);
#if LENS_IS_PARALLEL
  const float2 ratio = beside;
#else
  const float quotient = beside.x / z;
  const float2 ratio = (float2)(
      quotient, (fma(-quotient, z, beside.x) + beside.y) / z);
#endif
  const float high = view->focal[axis] * ratio.x;
  return (float2)(high, fma(view->focal[axis], ratio.x, -high) +
                            view->focal[axis] * ratio.y);
}

// The silhouette along an axis of the picture, px from where the centre is.
typedef struct {
  float middle, half_width;
} silhouette;

#if USE_SURFELS
// Squares of it times pixels are within fp32.
#define MOST_FACTOR 1e14f

// With the pixels that the low pass reaches around the centre.
static silhouette with_low_pass(silhouette s, float reach) {
  const float low = fmin(s.middle - s.half_width, -reach);
  const float high = fmax(s.middle + s.half_width, reach);
  return (silhouette){0.5f * (low + high), 0.5f * (high - low)};
}
#endif

// Pixels along an axis, both ends included; none if the first is the larger.
typedef struct {
  int first, last;
} pixel_span;

static pixel_span span_of(silhouette s, float place, float2 beside,
                          uint size) {
  const float at = place + beside.x + s.middle - 0.5f;
  return (pixel_span){(int)clamp(ceil(at - s.half_width), 0.0f, (float)size),
                      (int)clamp(floor(at + s.half_width), -1.0f,
                                 (float)size - 1.0f)};
}

// Where the centre is, from the centre of pixel `first`.
static float place_from(int first, float place, float2 beside) {
  const float2 sum = two_sum(place - ((float)first + 0.5f), beside.x);
  return sum.x + (sum.y + beside.y);
}

// Fills the record but its colour, and the rectangle; (x, y, z) is the mean `p`
// in the camera's axes. CULLED and the reason if no ray meets the Gaussian, else
// 0.
static uint meet_rays(VIEW_SPACE const splat_view *view,
                      VIEW_SPACE const splat_crop *crop, float3 p, float x,
                      float y, float z, float4 activated, float4 unit, uint i,
                      uint effects, __local splat_record *restrict g,
                      uint2 *rectangle) {
  const float ratio = 255.0f / ALPHA_CUTOFF * activated.w;
  if (USE_FAINT && !(ratio >= 1.0f))
    return CULLED + CULL_FAINT;
  // Of the largest, so that products of four stay in fp32's range.
  const float largest = fmax(fmax(activated.x, activated.y), activated.z);
  if (!(largest > 0.0f))
    return CULLED + CULL_DEGENERATE;
  const float3 s = activated.xyz / largest;
  const float3 others = (float3)(s.y * s.z, s.x * s.z, s.x * s.y);
  // A vector has a component for each of the Gaussian's axes.
  const camera_axes e = to_camera(view, rotate_axes(unit));
#if LENS_IS_PARALLEL
  const float3 across_x = s * e.y;
  const float3 across_y = -(s * e.x);
  const float3 ahead = others * e.z;
  const float depth = 1.0f;
#else
  const float3 across_x = s * (e.y * z - e.z * y);
  const float3 across_y = s * (e.z * x - e.x * z);
  const float3 ahead = others * (e.x * x + e.y * y + e.z * z);
  const float depth = z;
#endif
  const float square = dot(ahead, ahead);
  const float along_x = sqrt(dot(across_x, across_x));
  // The rays lie in the disc, or there is only a line to meet.
  const bool is_met = square != 0.0f && along_x != 0.0f;
#if !USE_SURFELS
  if (!is_met)
    return CULLED + CULL_DEGENERATE;
#endif
  const float fx = view->focal[0], fy = view->focal[1];
  const float per_pixel = depth / (sqrt(square) * largest);
  g->factor[0] = per_pixel * along_x / fx;
  g->factor[1] = per_pixel * (dot(across_x, across_y) / along_x) / fy;
  g->factor[2] = depth * depth / (along_x * largest) / fy;
#if LENS_IS_PARALLEL
  g->slope[0] = g->slope[1] = g->near = 0.0f;
#else
  const float3 plane = ahead * others;
  g->slope[0] = depth * dot(plane, e.x) / square / fx;
  g->slope[1] = depth * dot(plane, e.y) / square / fy;
  // Of a Gaussian beyond fp32's range the quotient is 0, as it nearly is.
  const float reciprocal = s.x * s.y * s.z * largest / sqrt(square);
  g->near = fmin(reciprocal * reciprocal, FLT_MAX);
#endif
#if USE_SURFELS
  // From the edge, too, the low pass sees it.
  for (uint k = 0; k < 3; ++k)
    g->factor[k] = is_met ? clamp(g->factor[k], -MOST_FACTOR, MOST_FACTOR)
                          : MOST_FACTOR;
  for (uint k = 0; k < 2; ++k)
    g->slope[k] = is_met ? g->slope[k] : 0.0f;
#endif
  g->opacity = activated.w;

  // alpha is at least the cut-off inside an ellipsoid, whose dual quadric the
  // picture has as a dual conic: tangents to that are the box.
  const float reach =
      SQUARE_AT(log(fmax(1.0f, ratio))) * largest * largest;
  silhouette sx, sy;
#if LENS_IS_PARALLEL
  sx = (silhouette){0.0f, fabs(fx) * sqrt(reach * dot(across_y, across_y))};
  sy = (silhouette){0.0f, fabs(fy) * sqrt(reach * dot(across_x, across_x))};
  const float rounding = 1e-5f;
#else
  const float3 deep = s * e.z;
  const float in_front = z * z - reach * dot(deep, deep);
  // Below that it is behind the camera, too, or nearly so, and anywhere.
  const bool is_anywhere = !(in_front > 1e-3f * (z * z));
  const float3 beside_x = others * e.x, beside_y = others * e.y;
  sx = (silhouette){
      fx * (reach * dot(deep, across_y) / (z * in_front)),
      fabs(fx) * sqrt(fmax(0.0f, reach * (dot(across_y, across_y) -
                                          reach * dot(beside_y, beside_y)))) /
          in_front};
  sy = (silhouette){
      -fy * (reach * dot(deep, across_x) / (z * in_front)),
      fabs(fy) * sqrt(fmax(0.0f, reach * (dot(across_x, across_x) -
                                          reach * dot(beside_x, beside_x)))) /
          in_front};
  const float rounding = 1e-5f * (z * z) / in_front;
#endif
  sx.half_width += rounding * (sx.half_width + fabs(sx.middle)) + 1e-3f;
  sy.half_width += rounding * (sy.half_width + fabs(sy.middle)) + 1e-3f;
#if USE_SURFELS
  // alpha is at least the cut-off up to q = 2 (dx^2 + dy^2) = 2 log(ratio).
  const float low_pass = sqrt(log(fmax(1.0f, ratio))) + 1e-3f;
  sx = with_low_pass(sx, low_pass);
  sy = with_low_pass(sy, low_pass);
#endif
#if !LENS_IS_PARALLEL
  if (is_anywhere)
    sx = sy = (silhouette){0.0f, INFINITY};
#endif

  const float2 at_x = pixels_beside(view, crop, 0, p, z);
  const float2 at_y = pixels_beside(view, crop, 1, p, z);
  const pixel_span columns =
      span_of(sx, crop->place[0], at_x, view->size[0]);
  const pixel_span rows = span_of(sy, crop->place[1], at_y, view->size[1]);
  g->mean[0] = place_from(columns.first, crop->place[0], at_x);
  g->mean[1] = place_from(rows.first, crop->place[1], at_y);
  const float zero = finite_zero(g->factor[0], g->factor[1], g->factor[2]) +
                     finite_zero(g->slope[0], g->slope[1], g->near) +
                     finite_zero(g->mean[0], g->mean[1], g->opacity);
  if (!(zero == 0.0f))
    return CULLED + CULL_NON_FINITE;
  if (columns.first > columns.last || rows.first > rows.last)
    return CULLED + CULL_OUTSIDE;
  g->first = (uint)columns.first | (uint)rows.first << 16;
  g->last = (uint)columns.last | (uint)rows.last << 16;
  const uint x0 = (uint)columns.first / TILE_SIZE;
  const uint y0 = (uint)rows.first / TILE_HEIGHT;
  const uint x1 = (uint)columns.last / TILE_SIZE + 1;
  const uint y1 = (uint)rows.last / TILE_HEIGHT + 1;
  g->tag =
      USE_INTERSECT_TAGS && (x1 - x0 > 1 || y1 - y0 > 1) ? i | SPANS_TILES : i;
  *rectangle = make_rectangle(x0, y0, x1, y1);
  return 0;
}
