// A Gaussian's axes, and normal numbers, for samples of it.
#pragma once

#include "activate.cl"
#include "layout.h"
#include "philox.h"

typedef struct {
  float3 axis[3]; // unit vectors, world
} axes_of_gaussian;

static axes_of_gaussian gaussian_axes(__global const float *geometry,
                                      uint count, uint i) {
  const float4 u = activate_quaternion(
      (float4)(geometry[PLANE_QUATERNION * count + i],
               geometry[(PLANE_QUATERNION + 1) * count + i],
               geometry[(PLANE_QUATERNION + 2) * count + i],
               geometry[(PLANE_QUATERNION + 3) * count + i]));
  const float w = u.x, x = u.y, y = u.z, z = u.w;
  return (axes_of_gaussian){
      {(float3)(1.0f - 2.0f * (y * y + z * z), 2.0f * (x * y + w * z),
                2.0f * (x * z - w * y)),
       (float3)(2.0f * (x * y - w * z), 1.0f - 2.0f * (x * x + z * z),
                2.0f * (y * z + w * x)),
       (float3)(2.0f * (x * z + w * y), 2.0f * (y * z - w * x),
                1.0f - 2.0f * (x * x + y * y))}};
}

// G. E. P. Box, M. E. Muller 1958: two normal numbers of two uniform ones.
static void normal_numbers(philox_words r, float *normal) {
  const float near = sqrt(-2.0f * log(philox_unit(r.word[0])));
  const float far = sqrt(-2.0f * log(philox_unit(r.word[2])));
  const float turn = 2.0f * philox_unit(r.word[1]);
  normal[0] = near * cospi(turn);
  normal[1] = near * sinpi(turn);
  normal[2] = far * cospi(2.0f * philox_unit(r.word[3]));
}
