// Where rays end at a mesh, and the rays that it reflects, for trace.cl.

#define VIEW_SPACE __local // covariance.cl

#include "covariance.cl"
#include "layout.h"
#include "local_view.cl"
#include "surface.cl"

#include <vorion_raster.h>

// From the camera's axes to the world's.
static float3 to_world(__local const splat_view *view, float3 v) {
  __local const float *w = view->rotation;
  return (float3)(w[0] * v.x + w[3] * v.y + w[6] * v.z,
                  w[1] * v.x + w[4] * v.y + w[7] * v.z,
                  w[2] * v.x + w[5] * v.y + w[8] * v.z);
}

// `visible` has a vx_visibility a pixel. A ray that meets no triangle goes on,
// and reflects none: that ends before it begins. `normals` are of corners, in
// the world's axes, where one of 0 is the triangle's own.
__kernel void mirror(__global const splat_view *camera,
                     __global const float4 *points,
                     __global const uint *corners,
                     __global const float *normals,
                     __global const uint2 *visible, __global float *rays,
                     __global float *reflected, uint count) {
  __local splat_view view;
  take_view(&view, camera);
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const uint triangle = visible[i].y;
  if (triangle == VR_NO_PRIMITIVE) {
    for (uint plane = 0; plane < RAY_FARTHEST; ++plane)
      reflected[plane * count + i] = rays[plane * count + i];
    reflected[RAY_FARTHEST * count + i] = -INFINITY;
    return;
  }
  __global const uint *corner = corners + 3 * triangle;
  const float3 origin = points[corner[0]].xyz;
  const float3 first = points[corner[1]].xyz - origin;
  const float3 second = points[corner[2]].xyz - origin;
  const uint width = view.size[0];
  const meeting m =
      meet(&view, origin, first, second, (float)(i % width) + 0.5f,
           (float)(i / width) + 0.5f);
  const float3 place = origin + m.u * first + m.v * second;
  rays[RAY_FARTHEST * count + i] = place.z;

  float3 normal = (float3)(0.0f, 0.0f, 0.0f);
  for (uint k = 0; k < 3; ++k) {
    __global const float *own = normals + 9 * triangle + 3 * k;
    const float share = k == 0 ? 1.0f - m.u - m.v : k == 1 ? m.u : m.v;
    normal += share * (float3)(own[0], own[1], own[2]);
  }
  if (!(dot(normal, normal) > 0.0f))
    normal = to_world(&view, cross(first, second));
  float3 along;
  along.x = rays[RAY_DIRECTION * count + i];
  along.y = rays[(RAY_DIRECTION + 1) * count + i];
  along.z = rays[(RAY_DIRECTION + 2) * count + i];
  along -= normal * (2.0f * dot(along, normal) / dot(normal, normal));
  const float3 from = to_world(&view, place);
  const float begins[3] = {from.x, from.y, from.z};
  const float goes[3] = {along.x, along.y, along.z};
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    reflected[(RAY_ORIGIN + k) * count + i] = begins[k];
    reflected[(RAY_ORIGIN_LOW + k) * count + i] = 0.0f;
    reflected[(RAY_DIRECTION + k) * count + i] = goes[k];
    reflected[(RAY_DIRECTION_LOW + k) * count + i] = 0.0f;
  }
  reflected[RAY_NEAREST * count + i] = 0.0f;
  reflected[RAY_FARTHEST * count + i] = INFINITY;
}
