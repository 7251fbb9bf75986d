// The rays of a picture's pixels, through their centres, for trace.cl.

// Rays are parallel (lens/Orthographic.cpp).
#pragma vorion choice effect USE_ORTHOGRAPHIC

#include "activate.cl"
#include "layout.h"

// start + x across + y down, as high + low.
static float2 affine(__constant const splat_ray_source *s, int k, float x,
                     float y) {
  const float across = x * s->across[0][k], down = y * s->down[0][k];
  const float2 first = two_sum(s->start[0][k], across);
  const float2 sum = two_sum(first.x, down);
  const float low =
      s->start[1][k] + (x * s->across[1][k] + y * s->down[1][k]) +
      (fma(x, s->across[0][k], -across) + fma(y, s->down[0][k], -down));
  return fast_two_sum(sum.x, sum.y + (first.y + low));
}

__kernel void trace_rays(__constant const splat_ray_source *source,
                         __global float *rays, uint width, uint count,
                         float nearest) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const float x = (float)(i % width), y = (float)(i / width);
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float2 own = affine(source, k, x, y);
    const float2 same = (float2)(source->same[0][k], source->same[1][k]);
#if USE_ORTHOGRAPHIC
    const float2 origin = own, direction = same;
#else
    const float2 origin = same, direction = own;
#endif
    rays[(RAY_ORIGIN + k) * count + i] = origin.x;
    rays[(RAY_ORIGIN_LOW + k) * count + i] = origin.y;
    rays[(RAY_DIRECTION + k) * count + i] = direction.x;
    rays[(RAY_DIRECTION_LOW + k) * count + i] = direction.y;
  }
  rays[RAY_NEAREST * count + i] = nearest;
  rays[RAY_FARTHEST * count + i] = INFINITY;
}
