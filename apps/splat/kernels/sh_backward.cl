// Colour's way back to the harmonics and the direction (sh.cl). Gradients of
// coefficient k of channel c are in plane 3 k + c.
#pragma once

// Degree of the harmonics that have gradients.
#pragma vorion choice uint SH_DEGREE

#include "planes.h"
#include "sh_basis.h"

#define SH_GRADIENT(k, c) sh_gradients[(3 * (k) + (c)) * count + i]

#define BACK_SH(k, basis)                                                      \
  do {                                                                         \
    const float b = (basis);                                                   \
    SH_GRADIENT(k, 0) = b * g.x;                                               \
    SH_GRADIENT(k, 1) = b * g.y;                                               \
    SH_GRADIENT(k, 2) = b * g.z;                                               \
  } while (0)

// The same for a basis function with derivatives by x, y, z.
#define BACK_SH_ALONG(k, basis, by_x, by_y, by_z)                              \
  do {                                                                         \
    BACK_SH(k, basis);                                                         \
    const float v = SH(k, 0) * g.x + SH(k, 1) * g.y + SH(k, 2) * g.z;          \
    by_unit += v * (float3)(by_x, by_y, by_z);                                 \
  } while (0)

// Takes dL/dcolour `g`, already 0 where the colour is clamped, of Gaussian i seen
// along `direction`; returns dL/ddirection.
static float3 sh_backward(__global const float *sh, uint count, uint i,
                          float3 direction, float3 g,
                          __global float *sh_gradients) {
  BACK_SH(0, SH_C0);
  float3 by_direction = (float3)(0.0f, 0.0f, 0.0f);
#if SH_DEGREE > 0
  const float length_squared = squared_length(direction);
  if (length_squared > 0.0f) {
    const float length = sqrt(length_squared);
    const float x = direction.x / length;
    const float y = direction.y / length;
    const float z = direction.z / length;
    float3 by_unit = (float3)(0.0f, 0.0f, 0.0f);
    const float c1 = SH_C1;
    BACK_SH_ALONG(1, -c1 * y, 0.0f, -c1, 0.0f);
    BACK_SH_ALONG(2, c1 * z, 0.0f, 0.0f, c1);
    BACK_SH_ALONG(3, -c1 * x, -c1, 0.0f, 0.0f);
#if SH_DEGREE > 1
    const float xx = x * x, yy = y * y, zz = z * z;
    const float c4 = SH_C2XY, c6 = SH_C2ZZ;
    const float c8 = SH_C2XX;
    BACK_SH_ALONG(4, c4 * x * y, c4 * y, c4 * x, 0.0f);
    BACK_SH_ALONG(5, -c4 * y * z, 0.0f, -c4 * z, -c4 * y);
    BACK_SH_ALONG(6, c6 * (2.0f * zz - xx - yy), -2.0f * c6 * x, -2.0f * c6 * y,
                  4.0f * c6 * z);
    BACK_SH_ALONG(7, -c4 * x * z, -c4 * z, 0.0f, -c4 * x);
    BACK_SH_ALONG(8, c8 * (xx - yy), 2.0f * c8 * x, -2.0f * c8 * y, 0.0f);
#if SH_DEGREE > 2
    const float c9 = SH_C3Y, c10 = SH_C3XYZ;
    const float c11 = SH_C3XZZ, c12 = SH_C3ZZZ;
    const float c14 = SH_C3ZXX;
    BACK_SH_ALONG(9, -c9 * y * (3.0f * xx - yy), -6.0f * c9 * x * y,
                  -3.0f * c9 * (xx - yy), 0.0f);
    BACK_SH_ALONG(10, c10 * x * y * z, c10 * y * z, c10 * x * z, c10 * x * y);
    BACK_SH_ALONG(11, -c11 * y * (4.0f * zz - xx - yy), 2.0f * c11 * x * y,
                  -c11 * (4.0f * zz - xx - 3.0f * yy), -8.0f * c11 * y * z);
    BACK_SH_ALONG(12, c12 * z * (2.0f * zz - 3.0f * xx - 3.0f * yy),
                  -6.0f * c12 * x * z, -6.0f * c12 * y * z,
                  3.0f * c12 * (2.0f * zz - xx - yy));
    BACK_SH_ALONG(13, -c11 * x * (4.0f * zz - xx - yy),
                  -c11 * (4.0f * zz - 3.0f * xx - yy), 2.0f * c11 * x * y,
                  -8.0f * c11 * x * z);
    BACK_SH_ALONG(14, c14 * z * (xx - yy), 2.0f * c14 * x * z,
                  -2.0f * c14 * y * z, c14 * (xx - yy));
    BACK_SH_ALONG(15, -c9 * x * (xx - 3.0f * yy), -3.0f * c9 * (xx - yy),
                  6.0f * c9 * x * y, 0.0f);
#endif
#endif
    // Through the normalisation: what lies along the direction is lost.
    const float radial = by_unit.x * x + by_unit.y * y + by_unit.z * z;
    by_direction = (by_unit - radial * (float3)(x, y, z)) / length;
    return by_direction;
  }
#endif
  for (uint k = 1; k < (SH_DEGREE + 1) * (SH_DEGREE + 1); ++k)
    BACK_SH(k, 0.0f);
  return by_direction;
}
