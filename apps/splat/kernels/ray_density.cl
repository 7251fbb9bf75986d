// A Gaussian's density where it is densest on a pixel's ray, by the order of
// operations that docs/abi.md gives.
#pragma once

#include "record.h"

// Places are columns and rows from the box's first pixel.
#define FROM_PIXEL(g, p, axis)                                                 \
  ((p)-0.5f - (float)((g)->first >> (16 * (axis)) & 0xffff))

#undef IN_BOX
#define IN_BOX(g, x, y)                                                        \
  (((x) >= 0.0f) & ((y) >= 0.0f) &                                             \
   ((x) <= (float)(((g)->last & 0xffff) - ((g)->first & 0xffff))) &            \
   ((y) <= (float)(((g)->last >> 16) - ((g)->first >> 16))))

// The exponent at pixel (x, y) of the box; no number where the ray has the
// Gaussian behind it.
static float power_at(__local const splat_record *g, float x, float y) {
  const float dx = x - g->mean[0];
  const float dy = y - g->mean[1];
  const float u = g->factor[0] * dx + g->factor[1] * dy;
  const float v = g->factor[2] * dy;
  const float beside = u * u + v * v;
  const float l = (1.0f + g->slope[0] * dx) + g->slope[1] * dy;
  const float power = -0.5f * (beside / (l * l + g->near * beside));
  return l > 0.0f ? power : NAN;
}
