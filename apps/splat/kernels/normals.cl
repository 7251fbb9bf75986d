// Where normals are asked for (effects/Normals.cpp): the lists are blended once
// more with normals for colours, as depth.cl does with depths.

#include "activate.cl"
#include "covariance.cl"
#include "layout.h"
#include "planes.h"
#include "record.h"

// A Gaussian's normal is its shortest axis, the first of equal ones, on the side
// that the camera sees; in the world's axes.
static float3 normal_of(VIEW_SPACE const splat_view *view,
                        __global const float *geometry) {
  const world_axes a = rotate_axes(activate_quaternion(
      (float4)(GEOMETRY(PLANE_QUATERNION), GEOMETRY(PLANE_QUATERNION + 1),
               GEOMETRY(PLANE_QUATERNION + 2), GEOMETRY(PLANE_QUATERNION + 3))));
  const float x = GEOMETRY(PLANE_LOG_SCALE);
  const float y = GEOMETRY(PLANE_LOG_SCALE + 1);
  const float z = GEOMETRY(PLANE_LOG_SCALE + 2);
  const float3 n = x <= y && x <= z ? a.q0 : y <= z ? a.q1 : a.q2;
  const float3 d = from_camera(
      view, (float3)(GEOMETRY(PLANE_MEAN), GEOMETRY(PLANE_MEAN + 1),
                     GEOMETRY(PLANE_MEAN + 2)));
  return dot_in_order(n, d) > 0.0f ? -n : n;
}

// `depths`: the keys that project wrote. What no tile sees has no record. Where
// a Gaussian stands several times, its copies are `stride` records apart.
__kernel void normals_for_colors(__constant const splat_view *view,
                                 __global const float *geometry,
                                 __global const uint *depths,
                                 __global splat_record *records, uint count,
                                 uint stride) {
  const uint at = get_global_id(0);
  if (at >= count || depths[at] >= CULLED)
    return;
  const uint i = at % stride;
  const float3 n = normal_of(view, geometry +
                                       i / LINE_WORDS * LINE_WORDS *
                                           GEOMETRY_PLANES +
                                       i % LINE_WORDS);
  records[at].color[0] = n.x;
  records[at].color[1] = n.y;
  records[at].color[2] = n.z;
}
