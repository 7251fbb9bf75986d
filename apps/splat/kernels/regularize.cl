// Weights on opacities and scales in the loss: `opacity` times their mean, and
// `scale` times the mean of all three scales. Adds their gradients by what is
// stored; both are over the number of summands already.

#include "activate.cl"
#include "layout.h"

__kernel void regularize(__global const float *geometry,
                         __global float *gradients, uint count, float opacity,
                         float scale) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const float4 a = activate_scales_and_opacity(
      (float4)(geometry[PLANE_LOG_SCALE * count + i],
               geometry[(PLANE_LOG_SCALE + 1) * count + i],
               geometry[(PLANE_LOG_SCALE + 2) * count + i],
               geometry[PLANE_LOGIT * count + i]));
  const float scales[3] = {a.x, a.y, a.z};
  for (uint k = 0; k < 3; ++k)
    gradients[(PLANE_LOG_SCALE + k) * count + i] += scale * scales[k];
  gradients[PLANE_LOGIT * count + i] += opacity * a.w * (1.0f - a.w);
}
