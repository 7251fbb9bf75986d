// What cameras other than pinholes share.
#pragma once

#include "covariance.cl"
#include "layout.h"
#include "lens_model.cl"

// Rows in pixels at a point `p` in the camera's axes.
static lens_rows lens_rows_at(VIEW_SPACE const splat_view *view,
                              VIEW_SPACE const splat_lens *lens, float3 p,
                              bool hold) {
  lens_rows j = lens_jacobian(view, lens, p, hold);
  j.x *= view->focal[0];
  j.y *= view->focal[1];
  return j;
}

static screen_covariance lens_covariance(lens_rows j, camera_axes a) {
  return covariance_of_rows(j.x.x * a.x + j.x.y * a.y + j.x.z * a.z,
                            j.y.x * a.x + j.y.y * a.y + j.y.z * a.z);
}

// Of places: the shorter way round where the picture closes.
static float2 lens_difference(float2 a, float2 b) {
  float2 d = a - b;
#if LENS_CLOSES
  d.x -= 2.0f * M_PI_F * rint(d.x * (0.5f * M_1_PI_F));
#endif
  return d;
}
