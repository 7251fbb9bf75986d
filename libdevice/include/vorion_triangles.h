/* Set-up of triangles for the rasterizer (docs/primitives.md), for kernels in
   OpenCL C or C; a host program includes vorion_abi.h before it. Coordinates
   are columns and rows of the picture, y down, in 1/256 pixel: pixel (0, 0) has
   its sample at (128, 128). They lie in the guard band, from
   -VX_GUARD_BAND to 2 VX_GUARD_BAND - 1. */
#ifndef VORION_TRIANGLES_H
#define VORION_TRIANGLES_H

#ifndef VORION_ABI_H
#include <vorion.h>
#endif

#define VX_SUBPIXEL_BITS 8
/* 65,536 pixels: the largest picture, and as much on each side. */
#define VX_GUARD_BAND (1 << 24)

typedef __INT64_TYPE__ vx_int64;

/* The largest integer that is not above value / 2^VX_SUBPIXEL_BITS. */
static inline vx_int64 vx_floor_pixel(vx_int64 value) {
  return value >> VX_SUBPIXEL_BITS;
}

/* First and last sample of an extent: of samples at least `low`, at most
   `high`; cut to 0 and `size` - 1. */
static inline int vx_first_sample(int low) {
  const int first = (int)vx_floor_pixel((vx_int64)low + 127);
  return first < 0 ? 0 : first;
}
static inline int vx_last_sample(int high, int size) {
  const int last = (int)vx_floor_pixel((vx_int64)high - 128);
  return last < size ? last : size - 1;
}

static inline int vx_least(const int v[3]) {
  const int least = v[0] < v[1] ? v[0] : v[1];
  return least < v[2] ? least : v[2];
}
static inline int vx_greatest(const int v[3]) {
  const int greatest = v[0] > v[1] ? v[0] : v[1];
  return greatest > v[2] ? greatest : v[2];
}

/* Writes the record of the triangle whose corners have the coordinates x, y and
   the depths `depth`, in a picture of width x height pixels. Either winding is
   drawn. A sample on an edge belongs to the triangle on the edge's right, or
   below a horizontal edge (the top-left rule), so that triangles which share
   edges cover each sample once. Returns 0, and writes nothing, if no sample can
   be covered. */
static inline int vx_triangle_setup(vx_triangle *out, const int x[3],
                                    const int y[3], const float depth[3],
                                    unsigned tag, int width, int height) {
  const int first_x = vx_first_sample(vx_least(x));
  const int first_y = vx_first_sample(vx_least(y));
  const int last_x = vx_last_sample(vx_greatest(x), width);
  const int last_y = vx_last_sample(vx_greatest(y), height);
  /* Twice the area, positive if the corners go clockwise on the picture. */
  const vx_int64 area = (vx_int64)(x[1] - x[0]) * (y[2] - y[0]) -
                        (vx_int64)(x[2] - x[0]) * (y[1] - y[0]);
  const int sign = area < 0 ? -1 : 1;
  float at_first = 0, step_x = 0, step_y = 0;
  if (area == 0 || first_x > last_x || first_y > last_y)
    return 0;
  for (int edge = 0; edge != 3; ++edge) {
    const int from = (edge + 1) % 3, to = (edge + 2) % 3;
    const int a = sign * (y[from] - y[to]), b = sign * (x[to] - x[from]);
    /* The function at the sample of pixel (0, 0), whose steps are 256 a and
       256 b. It is positive inside. */
    const vx_int64 origin =
        (vx_int64)a * (128 - x[from]) + (vx_int64)b * (128 - y[from]);
    const int owns_ties = a > 0 || (a == 0 && b > 0);
    const vx_int64 c = vx_floor_pixel(origin - !owns_ties);
    const vx_int64 there =
        origin + 256 * ((vx_int64)a * first_x + (vx_int64)b * first_y);
    out->a[edge] = a;
    out->b[edge] = b;
    out->c_low[edge] = (unsigned)c;
    out->c_high[edge] = (int)(c >> 32);
    at_first += (float)there * depth[edge];
    step_x += (float)a * depth[edge];
    step_y += (float)b * depth[edge];
  }
  {
    const float whole = (float)(sign * area);
    out->depth = at_first / whole;
    out->depth_step[0] = step_x / whole * 256.0f;
    out->depth_step[1] = step_y / whole * 256.0f;
  }
  out->first = (unsigned)first_x | (unsigned)first_y << 16;
  out->last = (unsigned)last_x | (unsigned)last_y << 16;
  out->tag = tag;
  return 1;
}

#endif
