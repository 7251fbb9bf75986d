// What the ways back through a camera share.
#pragma once

// gsplat: what is held at a limit follows the depth.
#pragma vorion choice flag LIMIT_FOLLOWS_DEPTH
// The opacity makes up for the dilation.
#pragma vorion choice flag ANTIALIASED
// Points outside the field of view are held at its limits
// (effects/FieldOfView.cpp).
#pragma vorion choice effect USE_FIELD_OF_VIEW

#include "covariance.cl"

#define KEEP_SEEN_POINTS

// The way back knows no scene: it goes by what is held.
#ifndef USE_FIELD_OF_VIEW
#define USE_FIELD_OF_VIEW 1
#endif

// Whether z and a coordinate's part of the Jacobian follow when that coordinate
// is held at its limit: gsplat differentiates t = limit z, INRIA holds t.
#ifdef LIMIT_FOLLOWS_DEPTH
#define HELD_FACTOR 1.0f
#else
#define HELD_FACTOR 2.0f
#endif

typedef struct {
  float xx, xy, yy;
} symmetric;

static float quadratic(symmetric g, float2 a, float2 b) {
  return g.xx * a.x * b.x + g.xy * (a.x * b.y + a.y * b.x) + g.yy * a.y * b.y;
}

static float2 apply(symmetric m, float2 a) {
  return (float2)(m.xx * a.x + m.xy * a.y, m.xy * a.x + m.yy * a.y);
}

// a x b with one rounding error of each product kept (Kahan).
static float cross2(float2 a, float2 b) {
  const float w = a.y * b.x;
  return fma(a.x, b.y, -w) - fma(a.y, b.x, -w);
}

// A Gaussian as it goes through the camera: its mean in the camera's axes, its
// own axes there as unit vectors, scales and opacity, and a unit quaternion.
typedef struct {
  float3 place;
  camera_axes axes, seen; // seen: with what the picture has of them
  float4 activated, unit;
} camera_gaussian;

// dL/d(what is blended of a Gaussian).
typedef struct {
  float3 conic; // the conic itself: xx, xy, yy
  symmetric moments;
  float2 mean;
  float opacity; // as it is blended
} splat_gradients;

// dL/d(what projecting begins with).
typedef struct {
  float opacity;
  float3 scale;
  float3 turn;  // a rotation about the Gaussian's own axes
  float3 place; // the mean in the camera's axes
} shape_gradients;

// dL/d(covariance) v of a vector whose product with the covariance's inverse is
// `p`.
static float2 by_covariance(const splat_gradients *by, float2 p) {
  const float2 v = apply(by->moments, p);
  return (float2)(-(by->conic.x * v.x + by->conic.y * v.y),
                  -(by->conic.y * v.x + by->conic.z * v.y));
}

#ifdef ANTIALIASED
// What the opacity that dilation takes from a Gaussian adds to that, unless it is
// held at ANTIALIAS_FLOOR: both determinants' gradients are adjugates, of which
// `adjugate` is the one before the dilation, times v. 1 - kept does not cancel.
static float2 by_compensation(screen_covariance s, float by_opacity,
                              float opacity, float2 adjugate, float2 v) {
  const float kept = s.det_sharp / s.det;
  const float f = by_opacity * opacity / (2.0f * sqrt(kept) * s.det);
  const float lost = DILATION * (s.xx + s.yy - DILATION) / s.det;
  return f * (lost * adjugate - kept * DILATION * v);
}
#endif

// The same as dL/d(logarithm of the share of the determinant that is kept).
static float by_share_kept(screen_covariance s, float by_opacity,
                           float opacity) {
#ifdef ANTIALIASED
  const float kept = s.det_sharp / s.det;
  if (kept > ANTIALIAS_FLOOR)
    return 0.5f * by_opacity * opacity * sqrt(kept);
#endif
  return 0.0f;
}

// What is left of the opacity.
static float compensation_of(screen_covariance s) {
#ifdef ANTIALIASED
  return sqrt(fmax(ANTIALIAS_FLOOR, s.det_sharp / s.det));
#else
  return 1.0f;
#endif
}
