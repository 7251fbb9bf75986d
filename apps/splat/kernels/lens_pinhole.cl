// A pinhole, for the unscented transform and rolling shutters.
#pragma once

// Points outside the field of view are held at its limits
// (effects/FieldOfView.cpp).
#pragma vorion choice effect USE_FIELD_OF_VIEW

#include "covariance.cl"
#include "crop.cl"
#include "layout.h"

#define LENS_IS_PINHOLE 1
#define LENS_HOLDS (USE_FIELD_OF_VIEW != 0)

static bool lens_at(VIEW_SPACE const splat_lens *lens, float3 p, float2 *at) {
  *at = (float2)(p.x / p.z, p.y / p.z);
  return p.z > 0.0f;
}

static lens_rows lens_jacobian(VIEW_SPACE const splat_view *view,
                               VIEW_SPACE const splat_lens *lens, float3 p,
                               bool hold) {
  float2 ratio = (float2)(p.x / p.z, p.y / p.z);
  if (hold)
    ratio = (float2)(clamp(ratio.x, view->ratio_low[0], view->ratio_high[0]),
                     clamp(ratio.y, view->ratio_low[1], view->ratio_high[1]));
  const lens_rows j = {(float3)(1.0f, 0.0f, -ratio.x) / p.z,
                       (float3)(0.0f, 1.0f, -ratio.y) / p.z};
  return j;
}

// The way back alone (backward.cl).
#ifdef HELD_FACTOR
static float3 lens_curvature(VIEW_SPACE const splat_view *view,
                             VIEW_SPACE const splat_lens *lens, float3 p,
                             lens_rows by, bool hold) {
  const float2 ratio = (float2)(p.x / p.z, p.y / p.z);
  float2 held = ratio;
  if (hold)
    held = (float2)(clamp(ratio.x, view->ratio_low[0], view->ratio_high[0]),
                    clamp(ratio.y, view->ratio_low[1], view->ratio_high[1]));
  const float2 by_z = (float2)(by.x.z, by.y.z);
  const float along =
      (held.x != ratio.x ? HELD_FACTOR : 2.0f) * held.x * by_z.x +
      (held.y != ratio.y ? HELD_FACTOR : 2.0f) * held.y * by_z.y;
  return (float3)(held.x != ratio.x ? 0.0f : -by_z.x,
                  held.y != ratio.y ? 0.0f : -by_z.y,
                  along - by.x.x - by.y.y) /
         (p.z * p.z);
}
#endif

// `beside` is x and y less those of the ray at depth z.
static float2 crop_mean(VIEW_SPACE const splat_view *view,
                        CROP_SPACE const splat_crop *crop, float2 beside,
                        float z) {
  return (float2)(view->focal[0] * beside.x / z + crop->place[0],
                  view->focal[1] * beside.y / z + crop->place[1]);
}
