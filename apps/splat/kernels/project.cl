// Projects every Gaussian: activation, covariance, support, colour. Writes the
// record that both blending kernels read, the depth key and the tile rectangle
// (x0 | y0 << 16, x1 | y1 << 16, ends excluded). A Gaussian that no tile sees
// gets CULLED and the reason as its key, an empty rectangle and no record.

// x - x is 0 for finite x and NaN otherwise.
static bool all_finite(float a, float b) {
  return (a - a) + (b - b) == 0.0f;
}

static bool all_finite_record(splat_gaussian g) {
  const float zero = (g.mean[0] - g.mean[0]) + (g.mean[1] - g.mean[1]) +
                     (g.conic[0] - g.conic[0]) + (g.conic[1] - g.conic[1]) +
                     (g.conic[2] - g.conic[2]) + (g.opacity - g.opacity) +
                     (g.color[0] - g.color[0]) + (g.color[1] - g.color[1]) +
                     (g.color[2] - g.color[2]);
  return zero == 0.0f;
}

// Depth along the camera's axis, rounded once: it decides the order, and two
// Gaussians that the exact depths order must not change places by rounding.
static float camera_depth(__constant const splat_view *view, float x, float y,
                          float z) {
  const float part[3] = {x, y, z};
  float2 sum = (float2)(view->depth_offset[0], view->depth_offset[1]);
  for (int k = 0; k < 3; ++k) {
    const float high = view->depth_axis[k] * part[k];
    const float low = fma(view->depth_axis[k], part[k], -high) +
                      view->depth_axis_low[k] * part[k];
    const float2 next = two_sum(sum.x, high);
    sum = (float2)(next.x, sum.y + (next.y + low));
  }
  return sum.x + sum.y;
}

// The depth key; the rectangle is left alone if the Gaussian is culled.
static uint project_one(__constant const splat_view *view,
                        __global const float *geometry,
                        __global const float *sh,
                        __global splat_gaussian *records, uint count, uint i,
                        uint2 *rectangle) {
#define GEOMETRY(plane) geometry[(plane) * count + i]
  const float px = GEOMETRY(PLANE_MEAN);
  const float py = GEOMETRY(PLANE_MEAN + 1);
  const float pz = GEOMETRY(PLANE_MEAN + 2);
  const uint effects = view->effects;
  __constant const float *w = view->rotation;
  const float z = camera_depth(view, px, py, pz);
  if (USE_NEAR_PLANE && !(KEEP_DEPTH(z)))
    return CULLED + (isnan(z) ? CULL_NON_FINITE : CULL_NEAR);
  const float3 d = from_camera(view, (float3)(px, py, pz));
  const float x = w[0] * d.x + w[1] * d.y + w[2] * d.z;
  const float y = w[3] * d.x + w[4] * d.y + w[5] * d.z;
  float2 ratio = (float2)(x / z, y / z);
  if (USE_FIELD_OF_VIEW)
    ratio = (float2)(clamp(ratio.x, view->ratio_low[0], view->ratio_high[0]),
                     clamp(ratio.y, view->ratio_low[1], view->ratio_high[1]));

  const float3 scale =
      (float3)(activate_scale(GEOMETRY(PLANE_LOG_SCALE)),
               activate_scale(GEOMETRY(PLANE_LOG_SCALE + 1)),
               activate_scale(GEOMETRY(PLANE_LOG_SCALE + 2)));
  const float4 quaternion = activate_quaternion(
      (float4)(GEOMETRY(PLANE_QUATERNION), GEOMETRY(PLANE_QUATERNION + 1),
               GEOMETRY(PLANE_QUATERNION + 2), GEOMETRY(PLANE_QUATERNION + 3)));
  const screen_covariance s =
      project_covariance(view, z, ratio, scale, quaternion);
  if (s.det <= 0.0f)
    return CULLED + CULL_DEGENERATE;
  if (!isfinite(s.det))
    return CULLED + CULL_NON_FINITE;

  splat_gaussian g;
  g.opacity = activate_opacity(GEOMETRY(PLANE_LOGIT));
  if (USE_ANTIALIAS)
    g.opacity *= sqrt(fmax(ANTIALIAS_FLOOR, s.det_sharp / s.det));
  g.mean[0] = view->focal[0] * x / z + view->center[0];
  g.mean[1] = view->focal[1] * y / z + view->center[1];
  const float inverse = 1.0f / s.det;
  g.conic[0] = s.yy * inverse;
  g.conic[1] = -s.xy * inverse;
  g.conic[2] = s.xx * inverse;

  float2 extent;
  if (!support_extent(s, g.opacity, effects, &extent))
    return CULLED + CULL_FAINT;
  uint x0, x1, y0, y1;
  tile_span(g.mean[0], extent.x, TILE_SIZE, view->size[0], view->tiles[0], &x0,
            &x1);
  tile_span(g.mean[1], extent.y, TILE_HEIGHT, view->size[1], view->tiles[1],
            &y0, &y1);
  if (x0 >= x1 || y0 >= y1)
    return CULLED + (all_finite(g.mean[0], g.mean[1]) ? CULL_OUTSIDE
                                                      : CULL_NON_FINITE);
  g.extent[0] = pixel_extent(extent.x);
  g.extent[1] = pixel_extent(extent.y);

  const float3 color = sh_color(sh, count, i, d, effects);
  g.color[0] = color.x;
  g.color[1] = color.y;
  g.color[2] = color.z;
  if (!all_finite_record(g))
    return CULLED + CULL_NON_FINITE;
  g.tag = i;
  if (USE_INTERSECT_TAGS && (x1 - x0 > 1 || y1 - y0 > 1))
    g.tag |= SPANS_TILES;
  records[i] = g;
  *rectangle = (uint2)(x0 | y0 << 16, x1 | y1 << 16);
  return as_uint(z);
#undef GEOMETRY
}

__kernel void project(__constant const splat_view *view,
                      __global const float *geometry, __global const float *sh,
                      __global splat_gaussian *records, __global uint *depths,
                      __global uint *order, __global uint2 *rectangles,
                      uint count) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  uint2 rectangle = (uint2)(0, 0);
  depths[i] = project_one(view, geometry, sh, records, count, i, &rectangle);
  order[i] = i;
  rectangles[i] = rectangle;
}
