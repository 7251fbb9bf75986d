// What traced rays (trace.cl) need of each Gaussian: its shape in the world's
// axes from the camera, its colour seen from there, and the box around what of
// it reaches the least alpha. No lens, no projection: rays may come from
// anywhere.

// Gaussians that no pixel can see (effects/Faint.cpp).
#pragma vorion choice effect USE_FAINT
// Parameters are activated already (effects/ActivatedScene.cpp).
#pragma vorion choice effect USE_ACTIVATED_SCENE
// The least alpha that is blended, in 1/255.
#pragma vorion choice float ALPHA_CUTOFF

#include "activate.cl"
#include "covariance.cl"
#include "falloff_degree.h"
#include "layout.h"
#include "planes.h"
#include "sh.cl"

// Beyond its exact size, so that no rounding of a ray's way through a box loses
// a hit: of the size itself, and of the distance from the camera.
#define BOX_ROUNDING 1e-5f
#define PLACE_ROUNDING 2e-6f

static bool all_finite3(float3 a) {
  return (a.x - a.x) + (a.y - a.y) + (a.z - a.z) == 0.0f;
}

// CULLED and the reason if no ray meets the Gaussian, else 0. `geometry` and
// `sh` are where its words of the first planes are.
static uint shape_of(__constant const splat_view *view,
                     __global const float *geometry, __global const float *sh,
                     uint count, uint i, float slack, uint effects,
                     splat_traced *t, float3 *low, float3 *high,
                     float3 *color) {
  const float3 p = (float3)(GEOMETRY(PLANE_MEAN), GEOMETRY(PLANE_MEAN + 1),
                            GEOMETRY(PLANE_MEAN + 2));
  float4 activated =
      (float4)(GEOMETRY(PLANE_LOG_SCALE), GEOMETRY(PLANE_LOG_SCALE + 1),
               GEOMETRY(PLANE_LOG_SCALE + 2), GEOMETRY(PLANE_LOGIT));
  float4 unit =
      (float4)(GEOMETRY(PLANE_QUATERNION), GEOMETRY(PLANE_QUATERNION + 1),
               GEOMETRY(PLANE_QUATERNION + 2), GEOMETRY(PLANE_QUATERNION + 3));
#if !USE_ACTIVATED_SCENE
  activated = activate_scales_and_opacity(activated);
  unit = activate_quaternion(unit);
#endif
  const float ratio = 255.0f / ALPHA_CUTOFF * activated.w;
  if (USE_FAINT && !(ratio >= 1.0f))
    return CULLED + CULL_FAINT;
  const float largest = fmax(fmax(activated.x, activated.y), activated.z);
  const float3 s = activated.xyz / largest;
  // A point, or a line: no ray meets it but by chance.
  if (!(largest > 0.0f) ||
      !(fmax(fmax(s.x * s.y, s.y * s.z), s.x * s.z) > 0.0f))
    return CULLED + CULL_DEGENERATE;
  const world_axes q = rotate_axes(unit);
  const float reach = sqrt(SQUARE_AT(log(fmax(1.0f, ratio)))) * largest;
  const float3 half_size =
      reach * sqrt((s.x * q.q0) * (s.x * q.q0) + (s.y * q.q1) * (s.y * q.q1) +
                   (s.z * q.q2) * (s.z * q.q2));
  float mean[3], mean_low[3];
  const float part[3] = {p.x, p.y, p.z};
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float2 from = two_sum(part[k], -view->position[k]);
    const float2 sum = two_sum(from.x, from.y - view->position_low[k]);
    mean[k] = sum.x;
    mean_low[k] = sum.y;
  }
  const float3 m = (float3)(mean[0], mean[1], mean[2]);
  const float far = fmax(fmax(fabs(m.x), fabs(m.y)), fabs(m.z));
  const float3 half_box =
      half_size + (BOX_ROUNDING * half_size + (PLACE_ROUNDING * far + slack));
  *low = m - half_box;
  *high = m + half_box;
  *t = (splat_traced){
      {mean[0], mean[1], mean[2]},
      {mean_low[0], mean_low[1], mean_low[2]},
      {q.q0.x, q.q0.y, q.q0.z, q.q1.x, q.q1.y, q.q1.z, q.q2.x, q.q2.y, q.q2.z},
      {s.x, s.y, s.z},
      1.0f / (largest * largest),
      activated.w};
  *color = sh_color(sh, count, i, from_camera(view, p), effects);
  if (!all_finite3(*low) || !all_finite3(*high) || !all_finite3(*color) ||
      !isfinite(activated.w))
    return CULLED + CULL_NON_FINITE;
  return 0;
}

// Writes shape, box and colour of each Gaussian, and in `keys` 0, or CULLED and
// the reason. `slack`: by how much rounding moves the rays' origins.
__kernel void trace_shapes(__constant const splat_view *view,
                           __global const float *geometries,
                           __global const float *colors_of_planes,
                           __global splat_traced *shapes,
                           __global float *boxes, __global float4 *colors,
                           __global uint *keys,
                           __global splat_shapes_seen *items, uint count,
                           float slack) {
  const uint effects = view->effects;
  splat_shapes_seen seen = {0, {0}, 0.0f};
  for (uint i = get_global_id(0); i < count; i += get_global_size(0)) {
    const uint block = i / LINE_WORDS, word = i % LINE_WORDS;
    splat_traced shape;
    float3 low, high, color;
    const uint key = shape_of(
        view, geometries + block * (GEOMETRY_PLANES * LINE_WORDS) + word,
        colors_of_planes + block * (SH_PLANES * LINE_WORDS) + word, count, i,
        slack, effects, &shape, &low, &high, &color);
    keys[i] = key;
    if (key != 0) {
      ++seen.culled[key - CULLED];
      continue;
    }
    ++seen.gaussians;
    seen.distance += fabs(shape.mean[0]) + fabs(shape.mean[1]) +
                     fabs(shape.mean[2]);
    shapes[i] = shape;
    __global float *box = boxes + BOX_WORDS * i;
    box[BOX_LOW] = low.x;
    box[BOX_LOW + 1] = low.y;
    box[BOX_LOW + 2] = low.z;
    box[BOX_HIGH] = high.x;
    box[BOX_HIGH + 1] = high.y;
    box[BOX_HIGH + 2] = high.z;
    colors[i] = (float4)(color, 0.0f);
  }
  items[get_global_id(0)] = seen;
}
