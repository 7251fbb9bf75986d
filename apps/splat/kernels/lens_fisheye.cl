// OpenCV's fisheye: a point at the angle t from the axis is seen at the distance
// t (1 + k1 t^2 + k2 t^4 + k3 t^6 + k4 t^8) from the principal point. Depth is
// the distance from the camera, so that it sees what is beside and behind it.
#pragma once

#include "covariance.cl"
#include "crop.cl"
#include "layout.h"

#define LENS_BY_DISTANCE 1
#define LENS_HOLDS false

// In the plane of the axis and the point: the angle, the distance from the axis
// with its direction, and the distance from the camera.
typedef struct {
  float angle, radius, distance;
  float2 out;
} lens_polar;

static lens_polar lens_polar_of(float3 p) {
  lens_polar f;
  const float squared = p.x * p.x + p.y * p.y;
  f.radius = sqrt(squared);
  f.angle = atan2(f.radius, p.z);
  f.distance = sqrt(squared + p.z * p.z);
  f.out = f.radius > 0.0f ? p.xy / f.radius : (float2)(1.0f, 0.0f);
  return f;
}

// The distorted angle over the angle, its derivative by the angle, and that of
// the latter, from the angle's square.
static float lens_angle_factor(VIEW_SPACE const splat_lens *lens, float q) {
  VIEW_SPACE const float *k = lens->k;
  return 1.0f + q * (k[0] + q * (k[1] + q * (k[2] + q * k[3])));
}

// Less 1, over q.
static float lens_growth(VIEW_SPACE const splat_lens *lens, float q) {
  VIEW_SPACE const float *k = lens->k;
  return 3.0f * k[0] +
         q * (5.0f * k[1] + q * (7.0f * k[2] + 9.0f * q * k[3]));
}

// The place over (x, y).
static float lens_scale(VIEW_SPACE const splat_lens *lens, lens_polar f,
                        float z) {
  return f.radius > 0.0f
             ? f.angle * lens_angle_factor(lens, f.angle * f.angle) / f.radius
             : 1.0f / z;
}

// Beyond the limit the distorted angle turns back.
static bool lens_at(VIEW_SPACE const splat_lens *lens, float3 p, float2 *at) {
  const lens_polar f = lens_polar_of(p);
  *at = lens_scale(lens, f, p.z) * p.xy;
  return f.angle < lens->limit;
}

static bool lens_is_held(VIEW_SPACE const splat_view *view,
                         VIEW_SPACE const splat_lens *lens, float3 p,
                         bool hold) {
  return false;
}

static lens_rows lens_jacobian(VIEW_SPACE const splat_view *view,
                               VIEW_SPACE const splat_lens *lens, float3 p,
                               bool hold) {
  const lens_polar f = lens_polar_of(p);
  const float q = f.angle * f.angle;
  const float growth =
      (1.0f + q * lens_growth(lens, q)) / (f.distance * f.distance);
  const float across = lens_scale(lens, f, p.z);
  const float along = growth * p.z - across; // more than across
  const float by_z = -growth * f.radius;
  const float2 e = f.out;
  const lens_rows j = {
      (float3)(across + e.x * e.x * along, e.x * e.y * along, e.x * by_z),
      (float3)(e.x * e.y * along, across + e.y * e.y * along, e.y * by_z)};
  return j;
}

// (growth - scale) over the radius, times the distance squared. Near the axis
// both are 1 / z: there the difference's series is taken.
static float lens_bulge(VIEW_SPACE const splat_lens *lens, lens_polar f,
                        float z) {
  if (!(f.radius > 0.0f))
    return 0.0f;
  VIEW_SPACE const float *k = lens->k;
  const float q = f.angle * f.angle;
  const float cosine = z / f.distance;
  const float over_sine = f.angle * f.distance / f.radius; // angle / sine
  const float bare =
      q < 0.09f ? -2.0f / 3.0f +
                      q * (1.0f / 45.0f - q * (13.0f / 3780.0f + q / 5400.0f))
                : (cosine - over_sine) / q;
  const float rest = k[0] + q * (k[1] + q * (k[2] + q * k[3]));
  return (bare + lens_growth(lens, q) * cosine - rest * over_sine) *
         (f.angle * over_sine);
}

static float3 lens_curvature(VIEW_SPACE const splat_view *view,
                             VIEW_SPACE const splat_lens *lens, float3 p,
                             lens_rows by, bool hold) {
  VIEW_SPACE const float *k = lens->k;
  const lens_polar f = lens_polar_of(p);
  const float q = f.angle * f.angle;
  // Derivatives of the distorted angle.
  const float first = 1.0f + q * lens_growth(lens, q);
  const float second =
      f.angle *
      (6.0f * k[0] + q * (20.0f * k[1] + q * (42.0f * k[2] + 72.0f * q * k[3])));
  const float squared = f.distance * f.distance;
  const float c = p.z / f.distance, s = f.radius / f.distance;
  // In the frame of out and across: rows by columns.
  const float2 e = f.out, t = (float2)(-f.out.y, f.out.x);
  const float2 out_row = e.x * by.x.xy + e.y * by.y.xy;
  const float2 across_row = t.x * by.x.xy + t.y * by.y.xy;
  const float out_out = dot(out_row, e), out_across = dot(out_row, t);
  const float across_out = dot(across_row, e);
  const float across_across = dot(across_row, t);
  const float out_z = e.x * by.x.z + e.y * by.y.z;
  const float across_z = t.x * by.x.z + t.y * by.y.z;
  const float bulge = lens_bulge(lens, f, p.z);
  const float mixed = -second * c * s - first * (c * c - s * s);
  const float by_out = (second * c * c - 2.0f * first * c * s) * out_out +
                       mixed * out_z + bulge * across_across;
  const float by_across =
      bulge * (across_out + out_across) - first * across_z;
  const float by_z = mixed * out_out +
                     (second * s * s + 2.0f * first * c * s) * out_z -
                     first * across_across;
  return (float3)(by_out * e.x + by_across * t.x,
                  by_out * e.y + by_across * t.y, by_z) /
         squared;
}

// The ray lies at the angle t0 from the axis, in the direction o0 across it.
// `beside` is the point's part along the two directions at right angles to the
// ray: out, by a greater angle, and around the axis. `ray` has t0, its cosine
// and sine, and o0.
static float2 crop_mean(VIEW_SPACE const splat_view *view,
                        VIEW_SPACE const splat_lens *lens,
                        CROP_SPACE const splat_crop *crop, float2 beside,
                        float3 p) {
  VIEW_SPACE const float *k = lens->k;
  const float t0 = crop->ray[0], cosine = crop->ray[1], sine = crop->ray[2];
  const float2 out0 = (float2)(crop->ray[3], crop->ray[4]);
  // The point in the frame of o0, across it and the axis. Near the axis `along`
  // is less than what rounding leaves of x and y.
  const float along = cosine > 0.5f ? (beside.x + p.z * sine) / cosine
                                    : dot(p.xy, out0);
  const float across = beside.y;
  const float radius = sqrt(along * along + across * across);
  // radius - along
  const float bend = along > 0.0f ? across * across / (radius + along)
                                  : radius - along;
  const float dt = atan2(bend * cosine + beside.x, radius * sine + p.z * cosine);
  const float t = t0 + dt;
  // The distorted angle is t F(t^2).
  const float q = t * t, q0 = t0 * t0;
  const float factor0 = lens_angle_factor(lens, q0);
  const float dfactor =
      dt * (t + t0) *
      divided_difference((float4)(k[0], k[1], k[2], k[3]), q, q0);
  const float place0 = t0 * factor0;
  const float dplace = dt * (factor0 + dfactor) + t0 * dfactor;
  const float2 turned = radius > 0.0f
                            ? (float2)(-bend, across) / radius
                            : (float2)(0.0f, 0.0f); // o less o0, in that frame
  const float place = place0 + dplace;
  const float from_out = dplace + place * turned.x;
  const float from_across = place * turned.y;
  return (float2)(
      view->focal[0] * (from_out * out0.x - from_across * out0.y) +
          crop->place[0],
      view->focal[1] * (from_out * out0.y + from_across * out0.x) +
          crop->place[1]);
}
