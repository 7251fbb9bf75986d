// From a Gaussian's sums back to its parameters: the way of project.cl, with the
// footprint (columns u_n of J R Q) taken once and the rest expressed in it, so
// that what must vanish for round Gaussians does. Gaussians that no tile sees
// get 0.

// Gradients are by the stored parameters, not the activated ones.
#pragma vorion choice flag STORED_PARAMETERS
// The gradients by the camera's pose are taken, too.
#pragma vorion choice flag POSES

#include "activate.cl"
#include "backward.cl"
#include "covariance.cl"
#include "layout.h"
#include "planes.h"
#include "record.h"
#include "sh_backward.cl"
#ifdef POSES
#include "pose.h"
#endif
#include "camera.cl"
#if USE_ROLLING_SHUTTER
#include "rolling_backward.cl"
#endif
#if USE_UNSCENTED
#include "unscented_backward.cl"
#endif
#if USE_NEEDLES
#include "across.cl"
#endif
#if USE_RAYS
#include "rays_backward.cl"
#endif

// Of the parameters as they are stored, or of activated scales and opacities.
#ifdef STORED_PARAMETERS
#define BY_SCALE(gradient, scale) ((gradient) * (scale))
#define BY_OPACITY(gradient, opacity)                                          \
  ((gradient) * ((opacity) * (1.0f - (opacity))))
#else
#define BY_SCALE(gradient, scale) (gradient)
#define BY_OPACITY(gradient, opacity) (gradient)
#endif

#define GRADIENT(plane) gradients[(plane) * count + i]
#if LENS_CLOSES
// A Gaussian and its copies beyond the picture's sides (project_copies.cl), of
// which those that no tile sees have no sums.
static float sum_of_copies(__global const float *sums,
                           __global const uint *depths, uint word, uint count,
                           uint i) {
  const uint whole = (count + LINE_WORDS - 1) / LINE_WORDS * LINE_WORDS;
  float sum = 0.0f;
  for (uint copy = 0; copy < 3; ++copy)
    if (depths[copy * whole + i] < CULLED)
      sum += sums[(3 * word + copy) * whole + i];
  return sum;
}
#define SUM(word) sum_of_copies(sums, depths, word, count, i)
#else
#define SUM(word) sums[(word) * count + i]
#endif

#if USE_NEEDLES
// Whether the Jacobian at a point in the camera's axes is held.
static bool is_held(__constant const splat_view *view, float3 p) {
#if HAS_LENS
  return lens_is_held(view, (__constant const splat_lens *)(view + 1), p,
                      LENS_HOLDS);
#else
  const float2 own = (float2)(p.x / p.z, p.y / p.z);
  return any(own != (float2)(clamp(own.x, view->ratio_low[0],
                                   view->ratio_high[0]),
                             clamp(own.y, view->ratio_low[1],
                                   view->ratio_high[1])));
#endif
}
#endif

// Through the Jacobian at the mean.
static shape_gradients jacobian_backward(__constant const splat_view *view,
                                         const camera_gaussian *g,
                                         const splat_gradients *by) {
  const camera_axes axes = g->axes, seen = g->seen;
  const float4 activated = g->activated;
  const float scale[3] = {activated.x, activated.y, activated.z};
#if HAS_LENS
  __constant const splat_lens *lens = (__constant const splat_lens *)(view + 1);
#if USE_ROLLING_SHUTTER
  rolling_point own;
  rolling_at(view, lens, g->place, &own);
  // On the still camera's picture, where the dilation is round.
  const rolling_rows rows = rolling_rows_at(view, lens, &own, LENS_HOLDS);
  const lens_rows j = rows.still;
  const splat_gradients still = rolling_still(by, rows.shear);
  by = &still;
#else
  const lens_rows j = lens_rows_at(view, lens, g->place, LENS_HOLDS);
#endif
  const float3 fx = j.x.x * seen.x + j.x.y * seen.y + j.x.z * seen.z;
  const float3 fy = j.y.x * seen.x + j.y.y * seen.y + j.y.z * seen.z;
#else
  const float z = g->place.z;
  const float2 ratio = (float2)(g->place.x / z, g->place.y / z);
  const float2 clamped =
      (float2)(clamp(ratio.x, view->ratio_low[0], view->ratio_high[0]),
               clamp(ratio.y, view->ratio_low[1], view->ratio_high[1]));
  const jacobian j = project_jacobian(view, z, clamped);
  const float3 fx = j.xx * seen.x + j.xz * seen.z;
  const float3 fy = j.yy * seen.y + j.yz * seen.z;
#endif
  const float2 u[3] = {(float2)(fx.x, fy.x), (float2)(fx.y, fy.y),
                       (float2)(fx.z, fy.z)};

  // p_n = K u_n with the conic K as the adjugate over the determinant. The
  // covariance is h I + sum s_n^2 u_n u_n^T, so a needle's long axis drops out of
  // its own p, of which K in fp32 has lost all digits.
#if HAS_LENS || USE_NEEDLES
  const screen_covariance s =
      covariance_of_rows(fx * activated.xyz, fy * activated.xyz);
#else
  const screen_covariance s = project_covariance(
      view, z, clamped, (float3)(scale[0], scale[1], scale[2]), g->unit);
#endif
  const float c01 = cross2(u[0], u[1]), c12 = cross2(u[1], u[2]);
  const float c20 = cross2(u[2], u[0]);
  const float2 turned[3] = {scale[0] * scale[0] * (float2)(-u[0].y, u[0].x),
                            scale[1] * scale[1] * (float2)(-u[1].y, u[1].x),
                            scale[2] * scale[2] * (float2)(-u[2].y, u[2].x)};
  const float2 adjugate[3] = {c20 * turned[2] - c01 * turned[1],
                              c01 * turned[0] - c12 * turned[2],
                              c12 * turned[1] - c20 * turned[0]};
  float2 p[3];
  for (uint n = 0; n < 3; ++n)
    p[n] = (adjugate[n] + DILATION * u[n]) / s.det;

  float2 by_axis[3]; // dL/d(covariance) u_n
  for (uint n = 0; n < 3; ++n)
    by_axis[n] = by_covariance(by, p[n]);
  float by_pair[3][3]; // u_m . dL/d(covariance) u_n, m <= n
  for (uint m = 0; m < 3; ++m)
    for (uint n = m; n < 3; ++n)
      by_pair[m][n] = -quadratic(by->moments, p[m], p[n]);
#ifdef ANTIALIASED
  if (s.det_sharp / s.det > ANTIALIAS_FLOOR)
    for (uint n = 0; n < 3; ++n) {
      const float2 v =
          by_compensation(s, by->opacity, activated.w, adjugate[n], u[n]);
      by_axis[n] += v;
      for (uint m = 0; m <= n; ++m)
        by_pair[m][n] += u[m].x * v.x + u[m].y * v.y;
    }
#endif

  shape_gradients to;
  to.opacity = by->opacity * compensation_of(s);
  to.scale = 2.0f * (float3)(scale[0] * by_pair[0][0], scale[1] * by_pair[1][1],
                             scale[2] * by_pair[2][2]);
  to.turn =
      2.0f *
      (float3)((scale[1] - scale[2]) * (scale[1] + scale[2]) * by_pair[1][2],
               (scale[2] - scale[0]) * (scale[2] + scale[0]) * by_pair[0][2],
               (scale[0] - scale[1]) * (scale[0] + scale[1]) * by_pair[0][1]);
#if HAS_LENS
  // dL/d(rows): 2 V U diag(s^2) times the axes.
  lens_rows by_rows = {(float3)(0.0f, 0.0f, 0.0f), (float3)(0.0f, 0.0f, 0.0f)};
  const float3 along[3] = {(float3)(axes.x.x, axes.y.x, axes.z.x),
                           (float3)(axes.x.y, axes.y.y, axes.z.y),
                           (float3)(axes.x.z, axes.y.z, axes.z.z)};
  for (uint n = 0; n < 3; ++n) {
    const float weight = 2.0f * scale[n] * scale[n];
    by_rows.x += weight * by_axis[n].x * along[n];
    by_rows.y += weight * by_axis[n].y * along[n];
  }
#if USE_ROLLING_SHUTTER
  const lens_rows free =
      rolling_moved(rolling_rows_at(view, lens, &own, false));
  to.place = free.x * by->mean.x + free.y * by->mean.y +
             rolling_rows_backward(view, lens, &own,
                                   rolling_by_way(lens, rows.shear, by),
                                   &by_rows, LENS_HOLDS);
#else
  by_rows.x *= view->focal[0];
  by_rows.y *= view->focal[1];
  const lens_rows free = lens_rows_at(view, lens, g->place, false);
  to.place = free.x * by->mean.x + free.y * by->mean.y +
             lens_curvature(view, lens, g->place, by_rows, LENS_HOLDS);
#endif
#else
  // dL/d(Jacobian's entries): 2 V U diag(s^2) times the axes.
  float by_xx = 0.0f, by_xz = 0.0f, by_yy = 0.0f, by_yz = 0.0f;
  const float ax[3] = {axes.x.x, axes.x.y, axes.x.z};
  const float ay[3] = {axes.y.x, axes.y.y, axes.y.z};
  const float az[3] = {axes.z.x, axes.z.y, axes.z.z};
  for (uint n = 0; n < 3; ++n) {
    const float weight = 2.0f * scale[n] * scale[n];
    const float gx = weight * by_axis[n].x, gy = weight * by_axis[n].y;
    by_xx += gx * ax[n];
    by_xz += gx * az[n];
    by_yy += gy * ay[n];
    by_yz += gy * az[n];
  }
  const float focal_x = view->focal[0] / z, focal_y = view->focal[1] / z;
  const bool held_x = clamped.x != ratio.x, held_y = clamped.y != ratio.y;
  to.place = (float3)(focal_x * by->mean.x, focal_y * by->mean.y, 0.0f);
  to.place.z = -(to.place.x * ratio.x + to.place.y * ratio.y);
  to.place.z -= (focal_x * by_xx + focal_y * by_yy) / z;
  to.place.z += (held_x ? HELD_FACTOR : 2.0f) * focal_x * clamped.x * by_xz / z;
  to.place.z += (held_y ? HELD_FACTOR : 2.0f) * focal_y * clamped.y * by_yz / z;
  to.place.x -= held_x ? 0.0f : focal_x * by_xz / z;
  to.place.y -= held_y ? 0.0f : focal_y * by_yz / z;
#endif
  return to;
}

static void project_backward_one(__constant const splat_view *view,
                                 __global const float *geometry,
                                 __global const float *sh,
                                 const splat_record record, float z,
                                 __global const uint *depths,
                                 __global const float *sums,
                                 __global float *gradients,
                                 __global float *sh_gradients, uint count,
                                 uint i) {
#if !USE_RAYS
  const float3 conic =
      (float3)(record.conic[0], record.conic[1], record.conic[2]);
  const float sx = SUM(SUM_SX), sy = SUM(SUM_SX + 1);
  const float2 by_mean2d =
      (float2)(conic.x * sx + conic.y * sy, conic.y * sx + conic.z * sy);
  const float3 by_conic = (float3)(-0.5f * SUM(SUM_SXX), -SUM(SUM_SXX + 1),
                                   -0.5f * SUM(SUM_SXX + 2));
  GRADIENT(GRADIENT_MEAN_2D) = by_mean2d.x;
  GRADIENT(GRADIENT_MEAN_2D + 1) = by_mean2d.y;
  GRADIENT(GRADIENT_CONIC) = by_conic.x;
  GRADIENT(GRADIENT_CONIC + 1) = by_conic.y;
  GRADIENT(GRADIENT_CONIC + 2) = by_conic.z;
#endif

  const float3 mean = (float3)(GEOMETRY(PLANE_MEAN), GEOMETRY(PLANE_MEAN + 1),
                               GEOMETRY(PLANE_MEAN + 2));
  __constant const float *r = view->rotation;
  const float3 d = from_camera(view, mean);
  camera_gaussian g;
  g.place.x = r[0] * d.x + r[1] * d.y + r[2] * d.z;
  g.place.y = r[3] * d.x + r[4] * d.y + r[5] * d.z;
#if LENS_BY_DISTANCE
  g.place.z = r[6] * d.x + r[7] * d.y + r[8] * d.z;
#else
  g.place.z = z;
#endif
  g.activated = activate_scales_and_opacity(
      (float4)(GEOMETRY(PLANE_LOG_SCALE), GEOMETRY(PLANE_LOG_SCALE + 1),
               GEOMETRY(PLANE_LOG_SCALE + 2), GEOMETRY(PLANE_LOGIT)));
  const float4 stored =
      (float4)(GEOMETRY(PLANE_QUATERNION), GEOMETRY(PLANE_QUATERNION + 1),
               GEOMETRY(PLANE_QUATERNION + 2), GEOMETRY(PLANE_QUATERNION + 3));
  const float4 unit = activate_quaternion(stored);
  g.unit = unit;
  g.axes = to_camera(view, rotate_axes(unit));
  g.seen = g.axes;
#if USE_NEEDLES
  if (!is_held(view, g.place))
    g.seen = to_camera(view, axes_across(view, mean, stored));
#endif
  // Never 0 where something was blended.
  const float by_opacity =
      SUM(SUM_S) == 0.0f ? 0.0f : SUM(SUM_S) / record.opacity;
#if USE_RAYS
  const ray_sums sum = {SUM(SUM_SX),      SUM(SUM_SX + 1),  SUM(SUM_SXX),
                        SUM(SUM_SXX + 1), SUM(SUM_SXX + 2), SUM(SUM_UQ),
                        SUM(SUM_UQ + 1),  SUM(SUM_QQ),
#if USE_SURFELS
                        SUM(SUM_LOW_PASS), SUM(SUM_LOW_PASS + 1)
#endif
  };
  shape_gradients to = rays_backward(view, &g, record.near, &sum);
  to.opacity = by_opacity;
  // A step of the mean that is a pixel on the picture.
#if LENS_IS_PARALLEL
  const float step = 1.0f;
#else
  const float step = z;
#endif
  GRADIENT(GRADIENT_MEAN_2D) = to.place.x * (step / view->focal[0]);
  GRADIENT(GRADIENT_MEAN_2D + 1) = to.place.y * (step / view->focal[1]);
  for (uint plane = 0; plane < 3; ++plane)
    GRADIENT(GRADIENT_CONIC + plane) = 0.0f;
#else
  const splat_gradients by = {
      conic,
      {by_conic.x, 0.5f * by_conic.y, by_conic.z},
      by_mean2d,
      by_opacity};

  shape_gradients to;
#if USE_UNSCENTED
  if (!unscented_backward(view, &g, &by, &to))
#endif
    to = jacobian_backward(view, &g, &by);
#endif

  GRADIENT(GRADIENT_OPACITY) = BY_OPACITY(to.opacity, g.activated.w);
  GRADIENT(GRADIENT_SCALE) = BY_SCALE(to.scale.x, g.activated.x);
  GRADIENT(GRADIENT_SCALE + 1) = BY_SCALE(to.scale.y, g.activated.y);
  GRADIENT(GRADIENT_SCALE + 2) = BY_SCALE(to.scale.z, g.activated.z);
  // dL/dq = 2 q (0, turn).
  const float factor = quaternion_factor(stored);
  const float4 near = stored * factor;
  const float length = sqrt(near.x * near.x + near.y * near.y +
                            near.z * near.z + near.w * near.w);
  // Over the stored length, of which 2^-103 is the least: by a subnormal one the
  // gradient would be beyond fp32, and its 0 times infinity no number.
  const float back =
      length > 0.0f ? fmin(2.0f * factor / length, 0x1p104f) : 0.0f;
  const float3 axis = (float3)(unit.y, unit.z, unit.w);
  const float3 vector = unit.x * to.turn + cross(axis, to.turn);
  GRADIENT(GRADIENT_QUATERNION) = -back * dot_in_order(axis, to.turn);
  GRADIENT(GRADIENT_QUATERNION + 1) = back * vector.x;
  GRADIENT(GRADIENT_QUATERNION + 2) = back * vector.y;
  GRADIENT(GRADIENT_QUATERNION + 3) = back * vector.z;

  const float3 by_color =
      (float3)(record.color[0] > 0.0f ? SUM(SUM_COLOR) : 0.0f,
               record.color[1] > 0.0f ? SUM(SUM_COLOR + 1) : 0.0f,
               record.color[2] > 0.0f ? SUM(SUM_COLOR + 2) : 0.0f);
  const float3 by_direction =
      sh_backward(sh, count, i, d, by_color, sh_gradients);
#ifdef POSES
  GRADIENT(GRADIENT_DIRECTION) = by_direction.x;
  GRADIENT(GRADIENT_DIRECTION + 1) = by_direction.y;
  GRADIENT(GRADIENT_DIRECTION + 2) = by_direction.z;
#endif
  GRADIENT(GRADIENT_MEAN) = r[0] * to.place.x + r[3] * to.place.y +
                            r[6] * to.place.z + by_direction.x;
  GRADIENT(GRADIENT_MEAN + 1) = r[1] * to.place.x + r[4] * to.place.y +
                                r[7] * to.place.z + by_direction.y;
  GRADIENT(GRADIENT_MEAN + 2) = r[2] * to.place.x + r[5] * to.place.y +
                                r[8] * to.place.z + by_direction.z;
}

__kernel void project_backward(__constant const splat_view *view,
                               __global const float *geometry,
                               __global const float *sh,
                               __global const splat_record *records,
                               __global const uint *depths,
                               __global const float *sums,
                               __global float *gradients,
                               __global float *sh_gradients, uint count) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  if (depths[i] < CULLED) {
    project_backward_one(view, geometry, sh, records[i], as_float(depths[i]),
                         depths, sums, gradients, sh_gradients, count, i);
    return;
  }
  for (uint plane = 0; plane < GRADIENT_PLANES; ++plane)
    GRADIENT(plane) = 0.0f;
  for (uint plane = 0; plane < 3 * (SH_DEGREE + 1) * (SH_DEGREE + 1); ++plane)
    sh_gradients[plane * count + i] = 0.0f;
}
