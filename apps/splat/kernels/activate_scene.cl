// Where several pictures of a scene are drawn (effects/ActivatedScene.cpp): what
// no camera changes is computed once. Activated parameters take the places of
// the stored ones, in blocks (layout.h); project.cl loads them with
// USE_ACTIVATED_SCENE.

#include "activate.cl"
#include "layout.h"
#include "planes.h"

__kernel void activate_scene(__global float *all, uint count) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  __global float *geometry =
      all + i / LINE_WORDS * LINE_WORDS * GEOMETRY_PLANES + i % LINE_WORDS;
  const float4 activated = activate_scales_and_opacity(
      (float4)(GEOMETRY(PLANE_LOG_SCALE), GEOMETRY(PLANE_LOG_SCALE + 1),
               GEOMETRY(PLANE_LOG_SCALE + 2), GEOMETRY(PLANE_LOGIT)));
  const float4 unit = activate_quaternion(
      (float4)(GEOMETRY(PLANE_QUATERNION), GEOMETRY(PLANE_QUATERNION + 1),
               GEOMETRY(PLANE_QUATERNION + 2), GEOMETRY(PLANE_QUATERNION + 3)));
  GEOMETRY(PLANE_LOG_SCALE) = activated.x;
  GEOMETRY(PLANE_LOG_SCALE + 1) = activated.y;
  GEOMETRY(PLANE_LOG_SCALE + 2) = activated.z;
  GEOMETRY(PLANE_LOGIT) = activated.w;
  GEOMETRY(PLANE_QUATERNION) = unit.x;
  GEOMETRY(PLANE_QUATERNION + 1) = unit.y;
  GEOMETRY(PLANE_QUATERNION + 2) = unit.z;
  GEOMETRY(PLANE_QUATERNION + 3) = unit.w;
}
