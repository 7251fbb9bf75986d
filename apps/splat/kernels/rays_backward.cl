// The way back through what rays need of a Gaussian (rays.cl), by the envelope
// theorem: of the ray's nearest point to the mean, x, neither moves the square
// q of its distance along the ray. With y = (x - mean) over the covariance, by
// the Gaussian's own axes, dq = -2 y . dmean - 2 sum_k y_k^2 s_k ds_k, and so on;
// y is linear in U, V and q, whose moments the sums are (docs/abi.md,
// "Backward"). As there, nothing is divided by a scale.
#pragma once

#include "backward.cl"
#include "lens_model.cl"
#include "record.h"

// The moments of one Gaussian.
typedef struct {
  float u, v, uu, uv, vv, uq, vq, qq;
  float x, y; // of surfels: on the picture, px
} ray_sums;

// The component of each axis is that of the next but one, and so on.
static float3 next_axis(float3 a) { return a.yzx; }

static shape_gradients rays_backward(VIEW_SPACE const splat_view *view,
                                     const camera_gaussian *g, float near,
                                     const ray_sums *sum) {
  const float largest =
      fmax(fmax(g->activated.x, g->activated.y), g->activated.z);
  const float3 s = g->activated.xyz / largest;
  const float3 others = (float3)(s.y * s.z, s.x * s.z, s.x * s.y);
  const camera_axes e = g->axes;
  const float3 p = g->place;
#if LENS_IS_PARALLEL
  const float3 beside = e.y, along = e.z;
#else
  const float3 beside = e.y * p.z - e.z * p.y;
  const float3 along = e.x * p.x + e.y * p.y + e.z * p.z;
#endif
  const float3 ahead = others * along;
  const float across = sqrt(dot(s * beside, s * beside));
  const float square = dot(ahead, ahead);

  // y = by_u U + by_v V + by_q q.
  const float3 squares = s * s;
  const float3 left = next_axis(squares * beside) * next_axis(next_axis(along));
  const float3 right =
      next_axis(next_axis(squares * beside)) * next_axis(along);
  float3 by_u = (left - right) / (across * sqrt(square) * largest);
  float3 by_v = beside / (across * largest);
#if LENS_IS_PARALLEL
  float3 by_q = (float3)(0.0f, 0.0f, 0.0f);
#else
  float3 by_q = -(others * ahead) / square;
#endif
#if USE_SURFELS
  if (square == 0.0f || across == 0.0f) // the low pass alone
    by_u = by_v = by_q = (float3)(0.0f, 0.0f, 0.0f);
#endif

  const float q = sum->uu + sum->vv + near * sum->qq;
  const float3 y =
      MOMENT_FACTOR * (by_u * sum->u + by_v * sum->v + by_q * q);
  // Of the products of y's components, that with itself and with the next.
  const float3 own_u =
      MOMENT_FACTOR * (by_u * sum->uu + by_v * sum->uv + by_q * sum->uq);
  const float3 own_v =
      MOMENT_FACTOR * (by_u * sum->uv + by_v * sum->vv + by_q * sum->vq);
  const float3 own_q =
      MOMENT_FACTOR * (by_u * sum->uq + by_v * sum->vq + by_q * sum->qq);
  const float3 itself = by_u * own_u + by_v * own_v + by_q * own_q;
  const float3 with_next = next_axis(by_u) * own_u + next_axis(by_v) * own_v +
                           next_axis(by_q) * own_q;

  shape_gradients to;
  to.scale = g->activated.xyz * itself;
  const float3 scale = g->activated.xyz;
  to.turn = (float3)((scale.y - scale.z) * (scale.y + scale.z) * with_next.y,
                     (scale.z - scale.x) * (scale.z + scale.x) * with_next.z,
                     (scale.x - scale.y) * (scale.x + scale.y) * with_next.x);
  to.place = (float3)(dot(e.x, y), dot(e.y, y), dot(e.z, y));
#if USE_SURFELS
  // The low pass is exp(-|d|^2) of the pixel's distance d from the mean.
  const float by_x = 2.0f * sum->x * view->focal[0];
  const float by_y = 2.0f * sum->y * view->focal[1];
#if LENS_IS_PARALLEL
  to.place += (float3)(by_x, by_y, 0.0f);
#else
  to.place += (float3)(by_x, by_y, -(by_x * p.x + by_y * p.y) / p.z) / p.z;
#endif
#endif
  return to;
}
