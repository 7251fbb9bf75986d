// Prepares Gaussians for blend_by_ray.cl, which asks each for its depth along a
// pixel's ray. As in StopThePop (Radl et al. 2024), that is the depth at which
// the Gaussian's density along the ray is largest.

// Parameters are activated already (effects/ActivatedScene.cpp).
#pragma vorion choice effect USE_ACTIVATED_SCENE

#include "activate.cl"
#include "covariance.cl"
#include "layout.h"
#include "planes.h"

// From lengths along a Gaussian's axes to standard deviations, all of them times
// the smallest scale. That common factor changes no depth, and keeps numbers
// finite where a scale is 0.
static float3 ray_axis_factors(float3 scale) {
  const float least = fmin(fmin(scale.x, scale.y), scale.z);
  return (float3)(scale.x == least ? 1.0f : least / scale.x,
                  scale.y == least ? 1.0f : least / scale.y,
                  scale.z == least ? 1.0f : least / scale.z);
}

// `depths`: the keys that project wrote. A Gaussian that no tile sees gets no
// frame.
__kernel void ray_frames(__constant const splat_view *view,
                         __global const float *geometries,
                         __global const uint *depths,
                         __global splat_ray_frame *frames, uint count) {
  const uint i = get_global_id(0);
  if (i >= count || depths[i] >= CULLED)
    return;
  __global const float *geometry = geometries + i / LINE_WORDS * LINE_WORDS *
                                                    GEOMETRY_PLANES +
                                   i % LINE_WORDS;
  float4 scale =
      (float4)(GEOMETRY(PLANE_LOG_SCALE), GEOMETRY(PLANE_LOG_SCALE + 1),
               GEOMETRY(PLANE_LOG_SCALE + 2), 0.0f);
  float4 unit =
      (float4)(GEOMETRY(PLANE_QUATERNION), GEOMETRY(PLANE_QUATERNION + 1),
               GEOMETRY(PLANE_QUATERNION + 2), GEOMETRY(PLANE_QUATERNION + 3));
#if !USE_ACTIVATED_SCENE
  scale = activate_scales_and_opacity(scale);
  unit = activate_quaternion(unit);
#endif
  const world_axes q = rotate_axes(unit);
  const float3 factor = ray_axis_factors(scale.xyz);
  const camera_axes a = to_camera(view, q);
  const float3 d = from_camera(
      view, (float3)(GEOMETRY(PLANE_MEAN), GEOMETRY(PLANE_MEAN + 1),
                     GEOMETRY(PLANE_MEAN + 2)));
  const float3 mean =
      factor * (float3)(dot_in_order(q.q0, d), dot_in_order(q.q1, d),
                        dot_in_order(q.q2, d));
  const float3 across = factor * a.x, down = factor * a.y, ahead = factor * a.z;
  frames[i] = (splat_ray_frame){{across.x, across.y, across.z},
                                {down.x, down.y, down.z},
                                {ahead.x, ahead.y, ahead.z},
                                {mean.x, mean.y, mean.z}};
}
