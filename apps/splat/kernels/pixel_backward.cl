// The way back through one Gaussian in one pixel, with the arithmetic of
// docs/abi.md, "Backward". RECORD_SPACE: where the Gaussian lies.
#pragma once

// The least alpha that is blended, in 1/255.
#pragma vorion choice float ALPHA_CUTOFF
// gsplat: no gradient goes through an alpha that is clamped to 0.99.
#pragma vorion choice flag CLAMP_STOPS
// So many sums of absolute gradients are taken, too.
#pragma vorion choice optional uint ABSOLUTE_SUMS

#include "falloff.cl"
#include "layout.h"
#include "record.h"
#if USE_RAYS
#include "ray_density.cl"
#endif

#ifdef CLAMP_STOPS
#define CLAMPED(wanted) ((wanted) > 0.99f)
#else
#define CLAMPED(wanted) false
#endif

// For density control, also the sums of the absolute gradients by the mean (Ye
// et al. 2024, "AbsGS"): what pulls both ways does not cancel.
#ifdef ABSOLUTE_SUMS
#define ALL_SUMS (RECORD_SUMS + ABSOLUTE_SUMS)
#else
#define ALL_SUMS RECORD_SUMS
#endif

// Where the Gaussian is seen from a pixel: where the pixel's ray meets it, or
// (x, y) px from the pixel to the mean.
#if USE_RAYS
typedef ray_meeting pixel_offset;
#else
typedef float2 pixel_offset;
#endif

// `power`: the exponent there, in falloff()'s domain. `gradient`: dL/d(the
// pixel); `state`: the transmittance behind the Gaussian and the light from
// behind it, which become those in front. Adds to `sum`. False where the pixel
// has nothing of the Gaussian.
static bool pixel_backward(RECORD_SPACE const splat_record *g,
                           pixel_offset at, float power,
                           __local const float4 *gradient,
                           __local float2 *state, float *sum) {
  const float wanted = g->opacity * falloff(power);
  const float alpha = fmin(0.99f, wanted);
  if (!(alpha >= ALPHA_CUTOFF / 255.0f))
    return false;
  const float4 u = *gradient;
  const float2 s = *state; // transmittance, light from behind
  const float t = s.x / (1.0f - alpha);
  const float light =
      g->color[0] * u.x + g->color[1] * u.y + g->color[2] * u.z;
  const float gain = light - s.y;
  *state = (float2)(t, s.y + alpha * gain);
  const float weight = alpha * t;
  const float v = CLAMPED(wanted) ? 0.0f : wanted * (t * gain);
#if USE_RAYS
  const float k = at.l / at.far;
  const float x = at.u * k, y = at.v * k;
#else
  const float x = -at.x, y = -at.y;
#endif
#if USE_DEGREE4
  const float w = v * at.q;
#else
  const float w = v;
#endif
  const float vx = w * x, vy = w * y;
  sum[SUM_COLOR] += weight * u.x;
  sum[SUM_COLOR + 1] += weight * u.y;
  sum[SUM_COLOR + 2] += weight * u.z;
  sum[SUM_S] += v;
#if USE_SURFELS
  if (at.on_picture) {
    sum[SUM_LOW_PASS] += v * at.dx;
    sum[SUM_LOW_PASS + 1] += v * at.dy;
    return true;
  }
#endif
  sum[SUM_SX] += vx;
  sum[SUM_SX + 1] += vy;
  sum[SUM_SXX] += vx * x;
  sum[SUM_SXX + 1] += vx * y;
  sum[SUM_SXX + 2] += vy * y;
#if USE_RAYS
  sum[SUM_UQ] += vx * at.q;
  sum[SUM_UQ + 1] += vy * at.q;
  sum[SUM_QQ] += w * at.q * at.q;
#endif
#ifdef ABSOLUTE_SUMS
  sum[SUM_WORDS] += fabs(g->conic[0] * vx + g->conic[1] * vy);
  sum[SUM_WORDS + 1] += fabs(g->conic[1] * vx + g->conic[2] * vy);
#endif
  return true;
}
