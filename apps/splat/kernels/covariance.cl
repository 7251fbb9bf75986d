// From a scaled, rotated Gaussian to its covariance on the picture (EWA:
// Zwicker et al. 2001, "EWA volume splatting", with the 3DGS clamp). The order
// of operations is that of reference/Projection.h, which gives the same bits.
#pragma once

// Added to the covariance's diagonal, px^2.
#pragma vorion choice float DILATION

#include "layout.h"

// The least ratio of determinants whose root is the factor of antialiasing, by
// both rules (reference/Projection.h).
#define ANTIALIAS_FLOOR 2.5e-5f

// Where a kernel keeps the camera.
#ifndef VIEW_SPACE
#define VIEW_SPACE __constant
#endif

typedef struct {
  float xx, xy, yy; // with the dilation
  float det;        // of that
  float det_sharp;  // without the dilation
} screen_covariance;

// A point from the camera's centre, in the world's axes. Far from the origin the
// difference of R p and t would have lost what is left of it.
static float3 from_camera(VIEW_SPACE const splat_view *view, float3 p) {
  const float3 high =
      (float3)(view->position[0], view->position[1], view->position[2]);
  const float3 low = (float3)(view->position_low[0], view->position_low[1],
                              view->position_low[2]);
  return p - high - low;
}

static float dot_in_order(float3 a, float3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The axes of a rotated Gaussian; `unit` is (w, x, y, z).
typedef struct {
  float3 q0, q1, q2; // columns of Q, in the world
} world_axes;

static world_axes rotate_axes(float4 unit) {
  const float w = unit.x, x = unit.y, y = unit.z, k = unit.w;
  world_axes a;
  a.q0 = (float3)(1.0f - 2.0f * (y * y + k * k), 2.0f * (x * y + w * k),
                  2.0f * (x * k - w * y));
  a.q1 = (float3)(2.0f * (x * y - w * k), 1.0f - 2.0f * (x * x + k * k),
                  2.0f * (y * k + w * x));
  a.q2 = (float3)(2.0f * (x * k + w * y), 2.0f * (y * k - w * x),
                  1.0f - 2.0f * (x * x + y * y));
  return a;
}

// Rows of the camera's rotation times three columns.
typedef struct {
  float3 x, y, z;
} camera_axes;

static camera_axes to_camera(VIEW_SPACE const splat_view *view, world_axes q) {
  VIEW_SPACE const float *r = view->rotation;
  const float3 r0 = (float3)(r[0], r[1], r[2]);
  const float3 r1 = (float3)(r[3], r[4], r[5]);
  const float3 r2 = (float3)(r[6], r[7], r[8]);
  camera_axes a;
  a.x = (float3)(dot_in_order(r0, q.q0), dot_in_order(r0, q.q1),
                 dot_in_order(r0, q.q2));
  a.y = (float3)(dot_in_order(r1, q.q0), dot_in_order(r1, q.q1),
                 dot_in_order(r1, q.q2));
  a.z = (float3)(dot_in_order(r2, q.q0), dot_in_order(r2, q.q1),
                 dot_in_order(r2, q.q2));
  return a;
}

// The entries of the projection's Jacobian that are not 0, at depth z with the
// camera-space x/z and y/z, already clamped, in `ratio`.
typedef struct {
  float xx, xz, yy, yz;
} jacobian;

static jacobian project_jacobian(VIEW_SPACE const splat_view *view, float z,
                                 float2 ratio) {
  const float fx = view->focal[0], fy = view->focal[1];
  const jacobian j = {fx / z, -fx * (ratio.x * z) / (z * z), fy / z,
                      -fy * (ratio.y * z) / (z * z)};
  return j;
}

// That of a camera that is no pinhole: rows by a point in the camera's axes.
typedef struct {
  float3 x, y;
} lens_rows;

// The radial part of a pinhole's distortion: the place over (a, b), which are x/z
// and y/z, and its derivatives by q = a^2 + b^2.
typedef struct {
  float value, slope, curve;
} lens_radial;

// `value` at one q, and what it has beyond that at another.
typedef struct {
  float value, change;
} lens_change;

// Covariance on the picture from the rows b and c of B, the Jacobian times the
// Gaussian's axes. The determinant of B B^T + h I is taken as the sum of B's
// squared minors and h tr + h^2 (Cauchy-Binet): the difference xx yy - xy^2
// would lose a needle's whole short axis in fp32.
static screen_covariance covariance_of_rows(float3 b, float3 c) {
  const float xx = dot_in_order(b, b);
  const float yy = dot_in_order(c, c);
  const float3 minors = (float3)(b.x * c.y - b.y * c.x, b.x * c.z - b.z * c.x,
                                 b.y * c.z - b.z * c.y);

  screen_covariance s;
  s.xx = xx + DILATION;
  s.xy = dot_in_order(b, c);
  s.yy = yy + DILATION;
  s.det_sharp = dot_in_order(minors, minors);
  s.det = s.det_sharp + DILATION * (xx + yy) + DILATION * DILATION;
  return s;
}

// The camera's rows times a Gaussian's axes, each as long as its deviation.
static camera_axes scaled(VIEW_SPACE const splat_view *view, float3 scale,
                          world_axes q) {
  q.q0 *= scale.x;
  q.q1 *= scale.y;
  q.q2 *= scale.z;
  return to_camera(view, q);
}

static camera_axes scaled_axes(VIEW_SPACE const splat_view *view, float3 scale,
                               float4 unit) {
  return scaled(view, scale, rotate_axes(unit));
}

// Covariance of axes at depth z, at the camera-space x/z and y/z in `ratio`.
static screen_covariance covariance_of_axes(VIEW_SPACE const splat_view *view,
                                            float z, float2 ratio,
                                            camera_axes a) {
  const jacobian j = project_jacobian(view, z, ratio);
  return covariance_of_rows(j.xx * a.x + j.xz * a.z, j.yy * a.y + j.yz * a.z);
}

// Covariance of a Gaussian at depth z whose camera-space x/z and y/z, already
// clamped, are `ratio`.
static screen_covariance project_covariance(VIEW_SPACE const splat_view *view,
                                            float z, float2 ratio, float3 scale,
                                            float4 unit) {
  return covariance_of_axes(view, z, ratio, scaled_axes(view, scale, unit));
}
