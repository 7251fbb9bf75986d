// From gradients by the Gaussians to that by the camera's pose. A camera that
// moves sees what it would see if the whole scene moved the other way: so its
// gradient by its place is minus the sum of those by the means ("force"). If it
// turns about its centre, the scene turns the other way, but for the directions
// from which colours are seen, which stay: minus the sum of
// arm x (gradient by the mean, without what came through the direction), and of
// what turning each Gaussian itself gives ("torque"). All in the world's axes.

#include "layout.h"
#include "pose.h"

#define LANES 16

// `sums` gets POSE_TERMS of each group's `stretch` Gaussians, added up in a fixed
// order. The camera's centre is high + low.
__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
pose_back(__global const float *geometry, __global const float *gradients,
          __global const uint *depths, __global float *sums, uint count,
          uint stretch, float4 high, float4 low) {
  __local float parts[POSE_TERMS][LANES];
  const uint lane = get_local_id(0);
  const uint first = get_group_id(0) * stretch;
  const uint end = min(first + stretch, count);
  float3 force = (float3)(0.0f, 0.0f, 0.0f), torque = force;
  for (uint i = first + lane; i < end; i += LANES) {
    if (depths[i] >= CULLED)
      continue;
    const float3 by_mean = (float3)(gradients[GRADIENT_MEAN * count + i],
                                    gradients[(GRADIENT_MEAN + 1) * count + i],
                                    gradients[(GRADIENT_MEAN + 2) * count + i]);
    const float3 by_direction =
        (float3)(gradients[GRADIENT_DIRECTION * count + i],
                 gradients[(GRADIENT_DIRECTION + 1) * count + i],
                 gradients[(GRADIENT_DIRECTION + 2) * count + i]);
    const float3 arm =
        (float3)(geometry[PLANE_MEAN * count + i],
                 geometry[(PLANE_MEAN + 1) * count + i],
                 geometry[(PLANE_MEAN + 2) * count + i]) -
        high.xyz - low.xyz;
    const float w = geometry[PLANE_QUATERNION * count + i];
    const float3 v = (float3)(geometry[(PLANE_QUATERNION + 1) * count + i],
                              geometry[(PLANE_QUATERNION + 2) * count + i],
                              geometry[(PLANE_QUATERNION + 3) * count + i]);
    const float by_w = gradients[GRADIENT_QUATERNION * count + i];
    const float3 by_v =
        (float3)(gradients[(GRADIENT_QUATERNION + 1) * count + i],
                 gradients[(GRADIENT_QUATERNION + 2) * count + i],
                 gradients[(GRADIENT_QUATERNION + 3) * count + i]);
    force += by_mean;
    // A turn by a small angle adds half its axis times the quaternion.
    torque += cross(arm, by_mean - by_direction) +
              0.5f * (w * by_v - by_w * v + cross(v, by_v));
  }
  parts[0][lane] = force.x;
  parts[1][lane] = force.y;
  parts[2][lane] = force.z;
  parts[3][lane] = torque.x;
  parts[4][lane] = torque.y;
  parts[5][lane] = torque.z;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lane < POSE_TERMS) {
    float total = 0.0f;
    for (uint k = 0; k < LANES; ++k)
      total += parts[lane][k];
    sums[get_group_id(0) * POSE_TERMS + lane] = total;
  }
}
