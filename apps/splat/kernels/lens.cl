// What cameras other than pinholes share. The model's own file (lens_*.cl) has
//
//     lens_at         the place of a point in the camera's axes, in units of the
//                     focal lengths; false where the camera does not see it
//     lens_jacobian   the rows of the Jacobian of that, where the model holds it
//                     if `hold`
//     lens_curvature  dL/d(point) from dL/d(rows)
//     lens_is_held    whether it does so, if `hold`
//     LENS_HOLDS      whether projecting holds it
#pragma once

#include "covariance.cl"
#include "has_lens.h"
#include "layout.h"
#if USE_OPENCV
#include "lens_opencv.cl"
#elif USE_FISHEYE
#include "lens_fisheye.cl"
#elif USE_ORTHOGRAPHIC
#include "lens_orthographic.cl"
#elif USE_EQUIRECTANGULAR
#include "lens_equirectangular.cl"
#else
#include "lens_pinhole.cl"
#endif

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
#if USE_EQUIRECTANGULAR
  d.x -= 2.0f * M_PI_F * rint(d.x * (0.5f * M_1_PI_F));
#endif
  return d;
}
