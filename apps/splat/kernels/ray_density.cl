// A Gaussian's density where it is densest on a pixel's ray, by the order of
// operations that docs/abi.md gives. RECORD_SPACE: where the Gaussian lies.
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

// Where a ray meets a Gaussian.
typedef struct {
  float u, v, l;
  float far; // what the square of the distance is divided by
  float q;
#if USE_SURFELS
  float dx, dy;    // from the mean to the pixel
  bool on_picture; // the low pass has less than the disc
#endif
} ray_meeting;

// At pixel (x, y) of the box.
static ray_meeting meet(RECORD_SPACE const splat_record *g, float x, float y) {
  const float dx = x - g->mean[0];
  const float dy = y - g->mean[1];
  ray_meeting m;
  m.u = g->factor[0] * dx + g->factor[1] * dy;
  m.v = g->factor[2] * dy;
  const float beside = m.u * m.u + m.v * m.v;
  m.l = (1.0f + g->slope[0] * dx) + g->slope[1] * dy;
  m.far = m.l * m.l + g->near * beside;
  m.q = beside / m.far;
#if USE_SURFELS
  const float low_pass = 2.0f * (dx * dx + dy * dy);
  m.dx = dx;
  m.dy = dy;
  m.on_picture = !((m.l > 0.0f) & (m.q <= low_pass));
  m.q = m.on_picture ? low_pass : m.q;
#endif
  return m;
}

// The exponent there; no number where the ray has the Gaussian behind it, but
// of surfels, which the low pass always sees.
static float power_of(ray_meeting m) {
  const float power = POWER_AT(m.q);
#if USE_SURFELS
  return power;
#else
  return m.l > 0.0f ? power : NAN;
#endif
}
