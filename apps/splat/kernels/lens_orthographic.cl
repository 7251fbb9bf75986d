// Parallel rays: x and y as they are, at any depth.
#pragma once

#include "covariance.cl"
#include "crop.cl"
#include "layout.h"

#define LENS_IS_PARALLEL 1
#define LENS_HOLDS false

static bool lens_at(VIEW_SPACE const splat_lens *lens, float3 p, float2 *at) {
  *at = p.xy;
  return true;
}

static bool lens_is_held(VIEW_SPACE const splat_view *view,
                         VIEW_SPACE const splat_lens *lens, float3 p,
                         bool hold) {
  return false;
}

static lens_rows lens_jacobian(VIEW_SPACE const splat_view *view,
                               VIEW_SPACE const splat_lens *lens, float3 p,
                               bool hold) {
  const lens_rows j = {(float3)(1.0f, 0.0f, 0.0f), (float3)(0.0f, 1.0f, 0.0f)};
  return j;
}

static float3 lens_curvature(VIEW_SPACE const splat_view *view,
                             VIEW_SPACE const splat_lens *lens, float3 p,
                             lens_rows by, bool hold) {
  return (float3)(0.0f, 0.0f, 0.0f);
}

// `beside` is x and y less those of the ray.
static float2 crop_mean(VIEW_SPACE const splat_view *view,
                        VIEW_SPACE const splat_lens *lens,
                        CROP_SPACE const splat_crop *crop, float2 beside,
                        float3 p) {
  return (float2)(view->focal[0] * beside.x + crop->place[0],
                  view->focal[1] * beside.y + crop->place[1]);
}
