// Colour from spherical harmonics. Bands are effects (effects/ShBands.cpp): what
// is not done is neither in the buffer nor, without flags, in the program. Signs
// are those of the convention that 3DGS scenes store.
#pragma once

// The harmonics of band 1 (effects/ShBands.cpp).
#pragma vorion choice effect USE_SH1
// The harmonics of band 2 (effects/ShBands.cpp).
#pragma vorion choice effect USE_SH2
// The harmonics of band 3 (effects/ShBands.cpp).
#pragma vorion choice effect USE_SH3
// The view colors Gaussians (effects/ViewColor.cpp).
#pragma vorion choice effect USE_VIEW_COLOR

#include "planes.h"
#include "sh_basis.h"

// Planes of colours that are there: a number where no band has a flag.
#define SH_PLANES                                                              \
  (3u * (1u + (USE_SH1 ? 3u : 0u) + (USE_SH2 ? 5u : 0u) + (USE_SH3 ? 7u : 0u)))

// Adds basis * coefficient k of every channel.
#define ADD_SH(k, basis)                                                       \
  do {                                                                         \
    const float b = (basis);                                                   \
    color.x += b * SH(k, 0);                                                   \
    color.y += b * SH(k, 1);                                                   \
    color.z += b * SH(k, 2);                                                   \
  } while (0)

// Colour of Gaussian i seen along `direction`, from the camera to its mean, of
// any length; of zero length leaves the constant band alone.
static float3 sh_color(__global const float *sh, uint count, uint i,
                       float3 direction, uint effects) {
  float3 color = SH_C0 * (float3)(SH(0, 0), SH(0, 1), SH(0, 2));
  if (USE_VIEW_COLOR) {
    const float length_squared = squared_length(direction);
    if (length_squared > 0.0f) {
      const float length = sqrt(length_squared);
      const float x = direction.x / length;
      const float y = direction.y / length;
      const float z = direction.z / length;
      const float xx = x * x, yy = y * y, zz = z * z;
      uint k = 1; // where the next band's coefficients begin
      if (USE_SH1) {
        ADD_SH(k, -SH_C1 * y);
        ADD_SH(k + 1, SH_C1 * z);
        ADD_SH(k + 2, -SH_C1 * x);
        k += 3;
      }
      if (USE_SH2) {
        ADD_SH(k, SH_C2XY * x * y);
        ADD_SH(k + 1, -SH_C2XY * y * z);
        ADD_SH(k + 2, SH_C2ZZ * (2.0f * zz - xx - yy));
        ADD_SH(k + 3, -SH_C2XY * x * z);
        ADD_SH(k + 4, SH_C2XX * (xx - yy));
        k += 5;
      }
      if (USE_SH3) {
        ADD_SH(k, -SH_C3Y * y * (3.0f * xx - yy));
        ADD_SH(k + 1, SH_C3XYZ * x * y * z);
        ADD_SH(k + 2, -SH_C3XZZ * y * (4.0f * zz - xx - yy));
        ADD_SH(k + 3, SH_C3ZZZ * z * (2.0f * zz - 3.0f * xx - 3.0f * yy));
        ADD_SH(k + 4, -SH_C3XZZ * x * (4.0f * zz - xx - yy));
        ADD_SH(k + 5, SH_C3ZXX * z * (xx - yy));
        ADD_SH(k + 6, -SH_C3Y * x * (xx - 3.0f * yy));
      }
    }
  }
  return fmax(color + 0.5f, 0.0f);
}
