// Projects every Gaussian: activation, covariance, support, colour. Writes the
// record that both blending kernels read, the depth key and the tile rectangle.
// A Gaussian that no tile sees gets CULLED and the reason as its key, an empty
// rectangle and a record of no meaning.

// x - x is 0 for finite x and NaN otherwise.
static bool all_finite(float a, float b) { return (a - a) + (b - b) == 0.0f; }

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
static float camera_depth(__local const splat_view *view, float x, float y,
                          float z) {
  const float part[3] = {x, y, z};
  float2 sum = (float2)(view->depth_offset[0], view->depth_offset[1]);
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float high = view->depth_axis[k] * part[k];
    const float low = fma(view->depth_axis[k], part[k], -high) +
                      view->depth_axis_low[k] * part[k];
    const float2 next = two_sum(sum.x, high);
    sum = (float2)(next.x, sum.y + (next.y + low));
  }
  return sum.x + sum.y;
}

// Work-items of a group.
#ifndef LANES
#define LANES 16
#endif

// Planes of colours that are there: a number where no band has a flag.
#define SH_PLANES                                                              \
  (3u * (1u + (USE_SH1 ? 3u : 0u) + (USE_SH2 ? 5u : 0u) + (USE_SH3 ? 7u : 0u)))
// Words that a lane asks for ahead of their use: of geometry, and of all bands.
#define SH_AHEAD 3

// Local memory of a group. An argument of the kernel, so that the compiler
// reaches all of it from one register.
typedef struct {
  splat_view view;
  activation_constants activation;
  sh_constants sh;
  uint latest; // beginning of the last line with a record
  uint stage[LANES * RECORD_WORDS];
  uint touched[1 + SH_AHEAD][LANES]; // nobody reads them
} workspace;
_Static_assert(sizeof(workspace) <= PROJECT_LOCAL_BYTES,
               "kernels/layout.h has too few");

// The depth key; the rest is left alone if the Gaussian is culled. In blocks,
// `geometry` and `sh` are where its words of the first planes are.
static uint project_one(__local const workspace *c,
                        __global const float *geometry,
                        __global const float *sh, uint count, uint i,
                        uint effects, splat_gaussian *record,
                        uint2 *rectangle) {
  const float px = GEOMETRY(PLANE_MEAN);
  const float py = GEOMETRY(PLANE_MEAN + 1);
  const float pz = GEOMETRY(PLANE_MEAN + 2);
  __local const splat_view *view = &c->view;
  __local const float *w = view->rotation;
  const float z = camera_depth(view, px, py, pz);
  if (USE_NEAR_PLANE && !(KEEP_DEPTH(z)))
    return CULLED + (isnan(z) ? CULL_NON_FINITE : CULL_NEAR);
  const float4 stored =
      (float4)(GEOMETRY(PLANE_LOG_SCALE), GEOMETRY(PLANE_LOG_SCALE + 1),
               GEOMETRY(PLANE_LOG_SCALE + 2), GEOMETRY(PLANE_LOGIT));
  const float4 quaternion =
      (float4)(GEOMETRY(PLANE_QUATERNION), GEOMETRY(PLANE_QUATERNION + 1),
               GEOMETRY(PLANE_QUATERNION + 2), GEOMETRY(PLANE_QUATERNION + 3));
  const float3 d = from_camera(view, (float3)(px, py, pz));
  const float x = w[0] * d.x + w[1] * d.y + w[2] * d.z;
  const float y = w[3] * d.x + w[4] * d.y + w[5] * d.z;
  float2 ratio = (float2)(x / z, y / z);
  const float4 activated = activate_scales_and_opacity(&c->activation, stored);
  if (USE_FIELD_OF_VIEW)
    ratio = (float2)(clamp(ratio.x, view->ratio_low[0], view->ratio_high[0]),
                     clamp(ratio.y, view->ratio_low[1], view->ratio_high[1]));
  const screen_covariance s = project_covariance(
      view, z, ratio, activated.xyz, activate_quaternion(quaternion));
  if (s.det <= 0.0f)
    return CULLED + CULL_DEGENERATE;
  if (!isfinite(s.det))
    return CULLED + CULL_NON_FINITE;

  splat_gaussian g;
  g.opacity = activated.w;
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
    return CULLED +
           (all_finite(g.mean[0], g.mean[1]) ? CULL_OUTSIDE : CULL_NON_FINITE);
  g.extent[0] = pixel_extent(extent.x);
  g.extent[1] = pixel_extent(extent.y);

  const float3 color = sh_color(&c->sh, sh, count, i, d, effects);
  g.color[0] = color.x;
  g.color[1] = color.y;
  g.color[2] = color.z;
  if (!all_finite_record(g))
    return CULLED + CULL_NON_FINITE;
  g.tag = i;
  if (USE_INTERSECT_TAGS && (x1 - x0 > 1 || y1 - y0 > 1))
    g.tag |= SPANS_TILES;
  *record = g;
  *rectangle = make_rectangle(x0, y0, x1, y1);
  return as_uint(z);
}

#ifdef SCENE_IN_BLOCKS
// Asks for the lines of a block of Gaussians: each lane reads a word of other
// lines. Whoever uses the words waits for them.
static void touch(__global const uint *geometry, __global const uint *sh,
                  uint sh_planes, uint lane, uint *words) {
  words[0] = geometry[min(lane, GEOMETRY_PLANES - 1u) * LINE_WORDS];
#pragma unroll
  for (uint k = 0; k < SH_AHEAD; ++k)
    if (k * LANES < sh_planes)
      words[1 + k] = sh[min(k * LANES + lane, sh_planes - 1) * LINE_WORDS];
}
#endif

// A group is a warp and takes every so many LINE_WORDS Gaussians. Records go
// through local memory, so that they are written as whole lines: the cache
// fetches a line of which it gets a part.
__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
project(__constant const splat_view *camera, __global const float *geometry,
        __global const float *sh, __global uint *records, __global uint *depths,
        __global uint2 *rectangles, __global splat_seen *items, uint count,
        __local workspace *w) {
  const uint effects = camera->effects;
  const uint lane = get_local_id(0);
  const uint step = get_num_groups(0) * LANES;
  for (uint k = lane; k < sizeof(splat_view) / 4; k += LANES)
    ((__local uint *)&w->view)[k] = ((__constant const uint *)camera)[k];
  // What is written of a line may belong to nobody.
#pragma unroll
  for (uint k = 0; k < RECORD_WORDS; ++k)
    w->stage[k * LANES + lane] = 0;
  if (lane == 0) {
    w->activation = make_activation_constants();
    make_sh_constants(&w->sh, effects);
    w->latest = ~0u;
  }
  barrier(CLK_LOCAL_MEM_FENCE);

#ifdef SCENE_IN_BLOCKS
  const uint sh_planes = SH_PLANES;
#endif
  splat_seen seen = {0, {0}, 0, ~0u, 0};
  for (uint first = get_group_id(0) * LANES; first < count; first += step) {
    const uint i = first + lane;
#ifdef SCENE_IN_BLOCKS
    const uint next = min(first + step, count - 1) / LANES;
    uint ahead[1 + SH_AHEAD];
    touch((__global const uint *)geometry + next * GEOMETRY_PLANES * LINE_WORDS,
          (__global const uint *)sh + next * sh_planes * LINE_WORDS, sh_planes,
          lane, ahead);
    __global const float *own_geometry =
        geometry + first * GEOMETRY_PLANES + lane;
    __global const float *own_sh = sh + first * sh_planes + lane;
#else
    __global const float *own_geometry = geometry;
    __global const float *own_sh = sh;
#endif
    uint2 rectangle = (uint2)(0, 0);
    splat_gaussian g;
    uint key = CULLED;
    if (i < count) {
      key = project_one(w, own_geometry, own_sh, count, i, effects, &g,
                        &rectangle);
      depths[i] = key;
#pragma unroll
      for (uint k = 0; k < CULL_REASONS; ++k)
        seen.culled[k] += key == CULLED + k ? 1 : 0;
    }
    if (key < CULLED) {
      atomic_xchg(&w->latest, first);
      ++seen.gaussians;
      seen.pairs = add_sat(seen.pairs, rectangle_tiles(rectangle));
      seen.least_key = min(seen.least_key, key);
      seen.greatest_key = max(seen.greatest_key, key);
      const uint words[RECORD_WORDS] = {
          as_uint(g.mean[0]),   as_uint(g.mean[1]),   as_uint(g.conic[0]),
          as_uint(g.conic[1]),  as_uint(g.conic[2]),  as_uint(g.opacity),
          as_uint(g.color[0]),  as_uint(g.color[1]),  as_uint(g.color[2]),
          as_uint(g.extent[0]), as_uint(g.extent[1]), g.tag};
#pragma unroll
      for (uint k = 0; k < RECORD_WORDS; ++k)
        w->stage[lane * RECORD_WORDS + k] = words[k];
    }
    if (i < count)
      rectangles[i] = rectangle;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (w->latest == first)
#pragma unroll
      for (uint k = 0; k < RECORD_WORDS; ++k)
        records[first * RECORD_WORDS + k * LANES + lane] =
            w->stage[k * LANES + lane];
    barrier(CLK_LOCAL_MEM_FENCE);
#ifdef SCENE_IN_BLOCKS
    // Not before, so that nothing has waited for them.
#pragma unroll
    for (uint k = 0; k < 1 + SH_AHEAD; ++k)
      if (k == 0 || (k - 1) * LANES < sh_planes)
        w->touched[k][lane] = ahead[k];
#endif
  }
  items[get_global_id(0)] = seen;
}
