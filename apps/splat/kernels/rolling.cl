// A camera that moves while it exposes its picture (docs/cameras.md, "Rolling
// shutters"). A point is seen from where the camera is at the moment at which
// the point's own pixel is exposed: an equation, which Newton's method solves.
#pragma once

#include "lens.cl"

// Of a point in the axes of the camera's pose: what it is to the camera at its
// moment, how that changes in a whole exposure, and its place.
typedef struct {
  float3 p, rate;
  float2 at;
  float left;   // what the place's drift leaves of the shutter's way
  float moment; // from the pose's
} rolling_point;

// A picture that follows its shutter has no one moment for a point: the least
// share of the shutter's way that a point may fall behind it.
#define ROLLING_LEAST 0.25f
// Outside the picture time goes on, a whole exposure either way of the picture.
#define ROLLING_END 1.5f

static VIEW_SPACE const splat_shutter *
rolling_shutter_of(VIEW_SPACE const splat_lens *lens) {
  return (VIEW_SPACE const splat_shutter *)(lens + 1);
}

// `v` turned about the shutter's axis.
static float3 rolling_turned(VIEW_SPACE const splat_shutter *shutter,
                             float angle, float3 v) {
  const float3 axis =
      (float3)(shutter->axis[0], shutter->axis[1], shutter->axis[2]);
  const float half_sine = sin(0.5f * angle);
  const float3 across = cross(axis, v);
  return v + sin(angle) * across +
         2.0f * half_sine * half_sine * cross(axis, across);
}

// Along the way of the shutter, of a step on the picture.
static float rolling_by(VIEW_SPACE const splat_shutter *shutter, float2 step) {
  return shutter->moment[1] * step.x + shutter->moment[2] * step.y;
}

// What the near plane is compared with.
static float rolling_depth(const rolling_point *r) {
#if LENS_BY_DISTANCE
  return sqrt(dot_in_order(r->p, r->p));
#else
  return r->p.z;
#endif
}

// How fast the place moves by the rows `j`, px a whole exposure.
static float2 rolling_drift(const rolling_point *r, lens_rows j) {
  return (float2)(dot_in_order(j.x, r->rate), dot_in_order(j.y, r->rate));
}

// False where the camera does not see it.
static bool rolling_at_moment(VIEW_SPACE const splat_view *view,
                              VIEW_SPACE const splat_lens *lens, float3 q,
                              rolling_point *r) {
  VIEW_SPACE const splat_shutter *shutter = rolling_shutter_of(lens);
  const float3 motion =
      (float3)(shutter->motion[0], shutter->motion[1], shutter->motion[2]);
  const float3 axis =
      (float3)(shutter->axis[0], shutter->axis[1], shutter->axis[2]);
  const float angle = -shutter->angle * r->moment;
  r->p = rolling_turned(shutter, angle, q - r->moment * motion);
  if (!lens_at(lens, r->p, &r->at))
    return false;
  r->rate = -(shutter->angle * cross(axis, r->p)) -
            rolling_turned(shutter, angle, motion);
  const lens_rows j = lens_rows_at(view, lens, r->p, false);
  r->left = 1.0f - rolling_by(shutter, rolling_drift(r, j));
  return true;
}

// The same at the moment that is the point's own.
static bool rolling_at(VIEW_SPACE const splat_view *view,
                       VIEW_SPACE const splat_lens *lens, float3 q,
                       rolling_point *r) {
  VIEW_SPACE const splat_shutter *shutter = rolling_shutter_of(lens);
  r->moment = 0.0f;
  for (uint n = 0; n < 12; ++n) {
    if (!rolling_at_moment(view, lens, q, r))
      return false;
    const float2 place =
        (float2)(view->focal[0] * r->at.x + view->center[0],
                 view->focal[1] * r->at.y + view->center[1]);
    const float behind =
        r->moment - (shutter->moment[0] + rolling_by(shutter, place));
    const float next = clamp(r->moment - behind / fmax(r->left, ROLLING_LEAST),
                             -ROLLING_END, ROLLING_END);
    const bool there = fabs(next - r->moment) < 1e-6f;
    r->moment = next;
    if (there)
      break;
  }
  return rolling_at_moment(view, lens, q, r) &&
         (fabs(r->moment) >= ROLLING_END || r->left >= ROLLING_LEAST);
}

// Of steps on the picture that a camera sees which stands still at the moment,
// to those on this one: what is exposed later sees the point moved.
typedef struct {
  float xx, xy, yx, yy;
  float det;
} rolling_shear;

// By rows in the axes of the pose, of a camera that stands still at the moment,
// and the shear that its motion makes of its picture.
typedef struct {
  lens_rows still;
  rolling_shear shear;
} rolling_rows;

// 1 + drift way^T / left, left being what the drift leaves of the shutter's way.
// Added up so, a picture that is pressed together keeps its digits.
static rolling_shear rolling_shear_by(VIEW_SPACE const splat_shutter *shutter,
                                      float2 drift) {
  const float own = 1.0f - rolling_by(shutter, drift);
  const float left = fmax(own, ROLLING_LEAST);
  const float one = 1.0f + (left - own);
  const float2 way = (float2)(shutter->moment[1], shutter->moment[2]);
  const rolling_shear a = {(one - drift.y * way.y) / left,
                           drift.x * way.y / left, drift.y * way.x / left,
                           (one - drift.x * way.x) / left, one / left};
  return a;
}

// A step of the point moves its moment, too, and with it the camera. The drift
// is that of the same rows: where they are held for a point far beside the
// picture, its own drift would be of another place.
static rolling_rows rolling_rows_at(VIEW_SPACE const splat_view *view,
                                    VIEW_SPACE const splat_lens *lens,
                                    const rolling_point *r, bool hold) {
  VIEW_SPACE const splat_shutter *shutter = rolling_shutter_of(lens);
  const lens_rows j = lens_rows_at(view, lens, r->p, hold);
  const float angle = shutter->angle * r->moment;
  rolling_rows rows;
  // Where time stands still, nothing moves.
  const float2 drift = fabs(r->moment) < ROLLING_END ? rolling_drift(r, j)
                                                     : (float2)(0.0f, 0.0f);
  rows.shear = rolling_shear_by(shutter, drift);
  rows.still.x = rolling_turned(shutter, angle, j.x);
  rows.still.y = rolling_turned(shutter, angle, j.y);
  return rows;
}

// Those of the picture that is drawn.
static lens_rows rolling_moved(rolling_rows r) {
  const rolling_shear a = r.shear;
  const lens_rows j = {a.xx * r.still.x + a.xy * r.still.y,
                       a.yx * r.still.x + a.yy * r.still.y};
  return j;
}

// The covariance on the picture that is drawn, from the one that the still camera
// sees: each row of a picture has the dilation of a camera that stands still.
// `xx`, `xy`, `yy` are without the dilation, so that a needle keeps its width.
static screen_covariance rolling_covariance(rolling_shear a,
                                            screen_covariance still, float xx,
                                            float xy, float yy) {
  screen_covariance s;
  s.xx = xx + DILATION * (a.xx * a.xx + a.xy * a.xy);
  s.xy = xy + DILATION * (a.xx * a.yx + a.xy * a.yy);
  s.yy = yy + DILATION * (a.yx * a.yx + a.yy * a.yy);
  s.det_sharp = still.det_sharp * (a.det * a.det);
  s.det = still.det * (a.det * a.det);
  return s;
}

static screen_covariance rolling_lens_covariance(rolling_rows j,
                                                 camera_axes axes) {
  const lens_rows moved = rolling_moved(j);
  const float3 b =
      moved.x.x * axes.x + moved.x.y * axes.y + moved.x.z * axes.z;
  const float3 c =
      moved.y.x * axes.x + moved.y.y * axes.y + moved.y.z * axes.z;
  return rolling_covariance(j.shear, lens_covariance(j.still, axes),
                            dot_in_order(b, b), dot_in_order(b, c),
                            dot_in_order(c, c));
}

// The step of the still camera's picture that the shear makes `v` of.
static float2 rolling_unsheared(rolling_shear a, float2 v) {
  return (float2)(a.yy * v.x - a.xy * v.y, a.xx * v.y - a.yx * v.x) / a.det;
}
