// The unscented transform (Wu et al. 2025, "3DGUT", with alpha 1, beta 2, kappa
// 0): a Gaussian goes through the camera as seven of its points, the mean and
// sqrt(3) deviations along each axis either way, with weights 0 and 1/6 for the
// mean on the picture and 2 and 1/6 for the covariance.
#pragma once

#include "lens.cl"
#include "near.h"
#if USE_ROLLING_SHUTTER
#include "rolling.cl"
#endif

#define UNSCENTED_STEP 1.7320508f    // root of 3
#define UNSCENTED_WEIGHT 0.40824829f // root of 1/6

// Whether each point must be in front of the near plane.
#define HAS_NEAR_PLANE (!LENS_BY_DISTANCE && !LENS_IS_PARALLEL)

// A point as the camera sees it, by what its derivative needs.
typedef struct {
#if USE_ROLLING_SHUTTER
  rolling_point own;
#else
  float3 p;
  float2 at;
#endif
} seen_point;

// False where the camera does not see it.
static bool see_point(VIEW_SPACE const splat_view *view,
                      VIEW_SPACE const splat_lens *lens, float3 p,
                      seen_point *seen) {
#if USE_ROLLING_SHUTTER
  return rolling_at(view, lens, p, &seen->own);
#else
  seen->p = p;
  return lens_at(lens, p, &seen->at);
#endif
}

// Its place in units of the focal lengths.
static float2 place_of(const seen_point *seen) {
#if USE_ROLLING_SHUTTER
  return seen->own.at;
#else
  return seen->at;
#endif
}

typedef struct {
  float2 shift;  // from the place of the mean to the mean on the picture
  float2 off[7]; // from there to the points' places and, last, to the mean's
                 // own, times the root of the weight
#ifdef KEEP_SEEN_POINTS
  seen_point seen[6]; // for the way back
#endif
} unscented_points;

// Those of the mean `p`, whose own place is `at`; `a` are axes as long as the
// deviations. False where the Jacobian is the better one: the camera does not
// see one of them, or it is so far from the mean's place that the footprint is
// no ellipse.
static bool unscented_points_of(VIEW_SPACE const splat_view *view,
                                VIEW_SPACE const splat_lens *lens, float3 p,
                                float2 at, camera_axes a,
                                unscented_points *points) {
  const float3 axis[3] = {(float3)(a.x.x, a.y.x, a.z.x) * UNSCENTED_STEP,
                          (float3)(a.x.y, a.y.y, a.z.y) * UNSCENTED_STEP,
                          (float3)(a.x.z, a.y.z, a.z.z) * UNSCENTED_STEP};
  const float2 focal = (float2)(view->focal[0], view->focal[1]);
  float2 sum = (float2)(0.0f, 0.0f);
  bool within = true;
  for (uint n = 0; n < 6; ++n) {
    const float3 q = n % 2 == 0 ? p + axis[n / 2] : p - axis[n / 2];
#if HAS_NEAR_PLANE && !USE_ROLLING_SHUTTER
    if (!(KEEP_DEPTH(q.z)))
      return false;
#endif
    seen_point seen;
    if (!see_point(view, lens, q, &seen))
      return false;
#if HAS_NEAR_PLANE && USE_ROLLING_SHUTTER
    if (!(KEEP_DEPTH(seen.own.p.z)))
      return false;
#endif
    const float2 way = lens_difference(place_of(&seen), at);
    within &= dot(way, way) <= lens->most_spread;
#ifdef KEEP_SEEN_POINTS
    points->seen[n] = seen;
#endif
    points->off[n] = focal * way;
    sum += points->off[n];
  }
  points->shift = sum / 6.0f;
  for (uint n = 0; n < 6; ++n)
    points->off[n] = (points->off[n] - points->shift) * UNSCENTED_WEIGHT;
  points->off[6] = -points->shift * 1.4142135f;
  return within;
}

static screen_covariance
unscented_covariance(const unscented_points *points) {
  float xx = 0.0f, xy = 0.0f, yy = 0.0f, det = 0.0f;
  for (uint n = 0; n < 7; ++n) {
    const float2 off = points->off[n];
    xx += off.x * off.x;
    xy += off.x * off.y;
    yy += off.y * off.y;
    for (uint m = 0; m < n; ++m) {
      const float minor =
          points->off[m].x * off.y - points->off[m].y * off.x;
      det += minor * minor;
    }
  }
  screen_covariance s;
  s.xx = xx + DILATION;
  s.xy = xy;
  s.yy = yy + DILATION;
  s.det_sharp = det;
  s.det = det + DILATION * (xx + yy) + DILATION * DILATION;
  return s;
}

#if USE_ROLLING_SHUTTER
// The same where the dilation is that of the still camera, whose picture the
// points are then taken to.
static screen_covariance rolling_unscented_covariance(unscented_points *points,
                                                      rolling_shear a) {
  float xx = 0.0f, xy = 0.0f, yy = 0.0f;
  for (uint n = 0; n < 7; ++n) {
    const float2 off = points->off[n];
    xx += off.x * off.x;
    xy += off.x * off.y;
    yy += off.y * off.y;
    points->off[n] = rolling_unsheared(a, off);
  }
  return rolling_covariance(a, unscented_covariance(points), xx, xy, yy);
}
#endif
