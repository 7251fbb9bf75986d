// Gaussians that point at the camera (effects/Needles.cpp). The picture has of an
// axis only the part across the ray through the mean. Where an axis points at the
// camera that part is a small difference of large numbers, which is taken here of
// sums of two floats, (high, low). A rest along the ray is no error: it does not
// move on the picture.
#pragma once

// Gaussians that point at the camera (effects/Needles.cpp).
#pragma vorion choice effect USE_NEEDLES

#include "activate.cl"
#include "covariance.cl"
#include "layout.h"
#include "lens_model.cl"

static float2 product2(float a, float b) {
  const float high = a * b;
  return (float2)(high, fma(a, b, -high));
}

static float2 sum2(float2 a, float2 b) {
  const float2 sum = two_sum(a.x, b.x);
  return fast_two_sum(sum.x, sum.y + (a.y + b.y));
}

typedef struct {
  float2 x, y, z;
} vector2;

// From the camera to the mean, or where parallel rays go.
static vector2 ray_to(VIEW_SPACE const splat_view *view, float3 mean) {
#if LENS_IS_PARALLEL
  return (vector2){(float2)(view->depth_axis[0], view->depth_axis_low[0]),
                   (float2)(view->depth_axis[1], view->depth_axis_low[1]),
                   (float2)(view->depth_axis[2], view->depth_axis_low[2])};
#else
  const float part[3] = {mean.x, mean.y, mean.z};
  float2 ray[3];
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float2 from = two_sum(part[k], -view->position[k]);
    ray[k] = two_sum(from.x, from.y - view->position_low[k]);
  }
  return (vector2){ray[0], ray[1], ray[2]};
#endif
}

// a - factor b
static float2 less_times(float2 a, float factor, float2 b) {
  const float2 product = product2(factor, b.x);
  return sum2(a, (float2)(-product.x, -product.y - factor * b.y));
}

// `axis` less its part along `ray`, over `length`.
static float3 part_across(vector2 axis, vector2 ray, float length) {
  const float3 toward = (float3)(ray.x.x, ray.y.x, ray.z.x);
  const float along = dot((float3)(axis.x.x, axis.y.x, axis.z.x), toward) /
                      dot(toward, toward);
  return (float3)(less_times(axis.x, along, ray.x).x,
                  less_times(axis.y, along, ray.y).x,
                  less_times(axis.z, along, ray.z).x) /
         length;
}

// What rotate_axes() gives for the quaternion (w, x, y, z) as it is stored, less
// the parts along the ray to `mean`.
static world_axes axes_across(VIEW_SPACE const splat_view *view, float3 mean,
                              float4 stored) {
  stored *= quaternion_factor(stored);
  if (!(dot(stored, stored) > 0.0f))
    stored = (float4)(1.0f, 0.0f, 0.0f, 0.0f); // turns nothing
  const float w = stored.x, x = stored.y, y = stored.z, z = stored.w;
  const float2 ww = product2(w, w), xx = product2(x, x), yy = product2(y, y),
               zz = product2(z, z);
  const float2 xy = product2(x, y), xz = product2(x, z), yz = product2(y, z);
  const float2 wx = product2(w, x), wy = product2(w, y), wz = product2(w, z);
  const float2 near = sum2(ww, xx), far = sum2(yy, zz);
  const float2 one = sum2(ww, -xx), other = sum2(yy, -zz);
  const float length = near.x + far.x;
  const vector2 ray = ray_to(view, mean);
  world_axes a;
  a.q0 = part_across((vector2){sum2(near, -far), 2.0f * sum2(xy, wz),
                               2.0f * sum2(xz, -wy)},
                     ray, length);
  a.q1 = part_across((vector2){2.0f * sum2(xy, -wz), sum2(one, other),
                               2.0f * sum2(yz, wx)},
                     ray, length);
  a.q2 = part_across((vector2){2.0f * sum2(xz, wy), 2.0f * sum2(yz, -wx),
                               sum2(one, -other)},
                     ray, length);
  return a;
}
