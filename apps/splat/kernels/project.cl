// Projects every Gaussian: activation, covariance, support, colour. Writes the
// record that both blending kernels read, the depth key and the tile rectangle.
// A Gaussian that no tile sees gets CULLED and the reason as its key, an empty
// rectangle and a record of no meaning.

// The opacity makes up for the dilation (effects/Antialias.cpp).
#pragma vorion choice effect USE_ANTIALIAS
// Gaussians before the near plane (effects/NearPlane.cpp).
#pragma vorion choice effect USE_NEAR_PLANE
// Points outside the field of view are held at its limits
// (effects/FieldOfView.cpp).
#pragma vorion choice effect USE_FIELD_OF_VIEW
// Gaussians of several tiles are marked (effects/IntersectTags.cpp).
#pragma vorion choice effect USE_INTERSECT_TAGS
// Parameters are activated already (effects/ActivatedScene.cpp).
#pragma vorion choice effect USE_ACTIVATED_SCENE

#define VIEW_SPACE __local // covariance.cl

#include "activate.cl"
#include "camera_depth.cl"
#include "covariance.cl"
#include "layout.h"
#include "near.h"
#include "planes.h"
#include "project_memory.cl"
#include "rectangle.cl"
#include "sh.cl"
#include "support.cl"
#include "camera.cl"
#if USE_NEEDLES
#include "across.cl"
#endif
#if LENS_CLOSES
#include "project_copies.cl"
#endif
#include "record.h"

// x - x is 0 for finite x and NaN otherwise.
static bool all_finite(float a, float b) { return (a - a) + (b - b) == 0.0f; }

// 0 for three finite numbers and NaN otherwise.
static float finite_zero(float a, float b, float c) {
  return (a - a) + (b - b) + (c - c);
}

#if USE_RAYS
#include "rays.cl"
#endif

// The depth key, the record and the rectangle; if the Gaussian is culled, the
// key alone has a meaning. In blocks, `geometry` and `sh` are where its words
// of the first planes are. Each step begins with its own loads, so that little
// is alive across the loop of the exponential.
static uint project_one(__local workspace *c, __global const float *geometry,
                        __global const float *sh, uint count, uint i, uint lane,
                        uint effects, __local uint *unread,
                        __local splat_record *restrict g, uint2 *rectangle) {
  const float px = GEOMETRY(PLANE_MEAN);
  const float py = GEOMETRY(PLANE_MEAN + 1);
  const float pz = GEOMETRY(PLANE_MEAN + 2);
  __local const splat_view *view = &c->view;
  __local const float *w = view->rotation;
#if LENS_BY_DISTANCE
  const float z = camera_distance(view, (float3)(px, py, pz));
#else
  const float z = camera_depth(view, px, py, pz);
#endif
#if USE_ROLLING_SHUTTER
  // The near plane is that of the mean's own moment, below. The order is the
  // pose's, in which nothing behind the camera has a place.
  if (!(z > 0.0f))
#else
  if (USE_NEAR_PLANE && !(KEEP_DEPTH(z)))
#endif
    return CULLED + (isnan(z) ? CULL_NON_FINITE : CULL_NEAR);
  const uint asked0 = ASK_FOR_SH(0);
#if USE_ACTIVATED_SCENE
  const float4 activated =
      (float4)(GEOMETRY(PLANE_LOG_SCALE), GEOMETRY(PLANE_LOG_SCALE + 1),
               GEOMETRY(PLANE_LOG_SCALE + 2), GEOMETRY(PLANE_LOGIT));
  const uint asked1 = ASK_FOR_SH(1);
  const float4 unit =
      (float4)(GEOMETRY(PLANE_QUATERNION), GEOMETRY(PLANE_QUATERNION + 1),
               GEOMETRY(PLANE_QUATERNION + 2), GEOMETRY(PLANE_QUATERNION + 3));
#else
  const float4 activated = activate_scales_and_opacity(
      (float4)(GEOMETRY(PLANE_LOG_SCALE), GEOMETRY(PLANE_LOG_SCALE + 1),
               GEOMETRY(PLANE_LOG_SCALE + 2), GEOMETRY(PLANE_LOGIT)));
  const uint asked1 = ASK_FOR_SH(1);
  const float4 stored =
      (float4)(GEOMETRY(PLANE_QUATERNION), GEOMETRY(PLANE_QUATERNION + 1),
               GEOMETRY(PLANE_QUATERNION + 2), GEOMETRY(PLANE_QUATERNION + 3));
  const float4 unit = activate_quaternion(stored);
#endif
  const uint asked2 = ASK_FOR_SH(2);
  const float3 d = from_camera(view, (float3)(px, py, pz));
  const float x = w[0] * d.x + w[1] * d.y + w[2] * d.z;
  const float y = w[3] * d.x + w[4] * d.y + w[5] * d.z;
#if USE_RAYS
  const uint culled = meet_rays(view, &c->crop, (float3)(px, py, pz), x, y, z,
                                activated, unit, i, effects, g, rectangle);
  if (culled != 0)
    return culled;
  const float zero = 0.0f;
#else
#if HAS_LENS
#if LENS_BY_DISTANCE
  const float3 p = (float3)(x, y, w[6] * d.x + w[7] * d.y + w[8] * d.z);
#else
  const float3 p = (float3)(x, y, z);
#endif
#if USE_ROLLING_SHUTTER
  rolling_point own;
  if (!rolling_at(view, &c->lens, p, &own))
    return CULLED + (all_finite(x, y) ? CULL_OUTSIDE : CULL_NON_FINITE);
  if (!(KEEP_DEPTH(rolling_depth(&own))))
    return CULLED + (all_finite(x, y) ? CULL_NEAR : CULL_NON_FINITE);
  const float2 at = own.at;
#else
  float2 at;
  if (!lens_at(&c->lens, p, &at))
    return CULLED + (all_finite(x, y) ? CULL_OUTSIDE : CULL_NON_FINITE);
#endif
  camera_axes axes = scaled_axes(view, activated.xyz, unit);
#if USE_NEEDLES
  if (!lens_is_held(view, &c->lens, p, LENS_HOLDS))
    axes = scaled(view, activated.xyz,
                  axes_across(view, (float3)(px, py, pz), stored));
#endif
  screen_covariance s;
  float2 shift = (float2)(0.0f, 0.0f);
#if USE_UNSCENTED
  unscented_points points;
  if (unscented_points_of(view, &c->lens, p, at, axes, &points)) {
#if USE_ROLLING_SHUTTER
    s = rolling_unscented_covariance(
        &points, rolling_rows_at(view, &c->lens, &own, false).shear);
#else
    s = unscented_covariance(&points);
#endif
    shift = points.shift;
  } else
#endif
  {
#if USE_ROLLING_SHUTTER
    s = rolling_lens_covariance(
        rolling_rows_at(view, &c->lens, &own, LENS_HOLDS), axes);
#else
    s = lens_covariance(lens_rows_at(view, &c->lens, p, LENS_HOLDS), axes);
#endif
  }
#else
  float2 ratio = (float2)(x / z, y / z);
#if USE_NEEDLES
  const float2 own = ratio;
#endif
  if (USE_FIELD_OF_VIEW)
    ratio = (float2)(clamp(ratio.x, view->ratio_low[0], view->ratio_high[0]),
                     clamp(ratio.y, view->ratio_low[1], view->ratio_high[1]));
#if USE_NEEDLES
  // Where the Jacobian is held, the picture has what lies along the ray.
  const screen_covariance s = covariance_of_axes(
      view, z, ratio,
      scaled(view, activated.xyz,
             all(ratio == own)
                 ? axes_across(view, (float3)(px, py, pz), stored)
                 : rotate_axes(unit)));
#else
  const screen_covariance s =
      project_covariance(view, z, ratio, activated.xyz, unit);
#endif
#endif
  if (s.det <= 0.0f)
    return CULLED + CULL_DEGENERATE;
  if (!isfinite(s.det))
    return CULLED + CULL_NON_FINITE;

  float opacity = activated.w;
  if (USE_ANTIALIAS)
    opacity *= sqrt(fmax(ANTIALIAS_FLOOR, s.det_sharp / s.det));
#if USE_CROP
  const float2 beside = (float2)(beside_ray(view, &c->crop, 0, px, py, pz),
                                 beside_ray(view, &c->crop, 1, px, py, pz));
#if HAS_LENS
  const float2 mean = crop_mean(view, &c->lens, &c->crop, beside, p);
#else
  const float2 mean = crop_mean(view, &c->crop, beside, z);
#endif
  const float mean_x = mean.x, mean_y = mean.y;
#elif HAS_LENS
  const float mean_x = view->focal[0] * at.x + view->center[0] + shift.x;
  const float mean_y = view->focal[1] * at.y + view->center[1] + shift.y;
#else
  const float mean_x = view->focal[0] * x / z + view->center[0];
  const float mean_y = view->focal[1] * y / z + view->center[1];
#endif
  const float inverse = 1.0f / s.det;
  const float conic_xx = s.yy * inverse;
  const float conic_xy = -s.xy * inverse;
  const float conic_yy = s.xx * inverse;
  g->mean[0] = mean_x;
  g->mean[1] = mean_y;
  g->conic[0] = conic_xx;
  g->conic[1] = conic_xy;
  g->conic[2] = conic_yy;
  g->opacity = opacity;
  const float zero = finite_zero(conic_xx, conic_xy, conic_yy) +
                     finite_zero(mean_x, mean_y, opacity);

  float2 extent;
  if (!support_extent(s, opacity, effects, &extent))
    return CULLED + CULL_FAINT;
#if LENS_CLOSES
  c->reach[lane] = extent.x;
#endif
  uint x0, x1, y0, y1;
  tile_span(mean_x, extent.x, TILE_SIZE, view->size[0], view->tiles[0], &x0,
            &x1);
  tile_span(mean_y, extent.y, TILE_HEIGHT, view->size[1], view->tiles[1], &y0,
            &y1);
  if (x0 >= x1 || y0 >= y1)
    return CULLED +
           (all_finite(mean_x, mean_y) ? CULL_OUTSIDE : CULL_NON_FINITE);
  g->extent[0] = pixel_extent(extent.x);
  g->extent[1] = pixel_extent(extent.y);
  g->tag =
      USE_INTERSECT_TAGS && (x1 - x0 > 1 || y1 - y0 > 1) ? i | SPANS_TILES : i;
  *rectangle = make_rectangle(x0, y0, x1, y1);
#endif

  *unread = asked0 ^ asked1 ^ asked2;
  const float3 color = sh_color(sh, count, i, d, effects);
  g->color[0] = color.x;
  g->color[1] = color.y;
  g->color[2] = color.z;
  if (!(zero + finite_zero(color.x, color.y, color.z) == 0.0f))
    return CULLED + CULL_NON_FINITE;
  return as_uint(z);
}

// Where the group's next block begins, from `first` on; of those that the
// camera sees nothing of, what is to be written is written here.
static uint next_block(__local workspace *w, uint first, uint step, uint count,
                       uint lane) {
#if USE_CULL_BLOCKS
  for (; first < count; first += step) {
    const uint verdict = w->verdicts[first / LINE_WORDS];
    if (verdict == 0)
      break;
    if (first + lane < count) {
      w->depths[first + lane] = CULLED + (verdict - 1);
      ++w->found[verdict][lane];
    }
  }
#endif
  return first;
}

// A group is a warp and takes every so many LINE_WORDS Gaussians. Records go
// through local memory, so that they are written as whole lines: the cache
// fetches a line of which it gets a part.
__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
project(__constant const splat_view *camera, __global const float *geometry,
        __global const float *sh, __global uint *records, __global uint *depths,
        __global uint *rectangles, __global splat_seen *items, uint count,
#if USE_CULL_BLOCKS
        __global const uint *verdicts,
#endif
        __local workspace *w) {
  const uint effects = camera->effects;
  const uint lane = get_local_id(0);
  const uint step = get_num_groups(0) * LANES;
  for (uint k = lane; k < sizeof(splat_view) / 4; k += LANES)
    ((__local uint *)&w->view)[k] = ((__constant const uint *)camera)[k];
#if HAS_LENS
  for (uint k = lane; k < sizeof(splat_lens) / 4; k += LANES)
    ((__local uint *)&w->lens)[k] = ((__constant const uint *)(camera + 1))[k];
#endif
#if USE_ROLLING_SHUTTER
  for (uint k = lane; k < sizeof(splat_shutter) / 4; k += LANES)
    ((__local uint *)&w->shutter)[k] = BEHIND_LENS(camera)[k];
#endif
#if USE_CROP
  for (uint k = lane; k < sizeof(splat_crop) / 4; k += LANES)
    ((__local uint *)&w->crop)[k] = BEHIND_LENS(camera)[k];
#endif
  // What is written of a line may belong to nobody.
#pragma unroll
  for (uint k = 0; k < RECORD_WORDS; ++k)
    w->stage.words[k * LANES + lane] = 0;
#pragma unroll
  for (uint k = 0; k < 2 + CULL_REASONS; ++k)
    w->found[k][lane] = 0;
  w->pairs[lane] = 0;
  w->least_key[lane] = ~0u;
  w->greatest_key[lane] = 0;
#ifdef SCENE_IN_BLOCKS
  const uint sh_planes = SH_PLANES;
  w->lines[0][lane] = min(lane, GEOMETRY_PLANES - 1u) * LINE_WORDS - lane;
#pragma unroll
  for (uint k = 0; k < SH_AHEAD; ++k)
    w->lines[1 + k][lane] =
        min(k * LANES + lane, sh_planes - 1) * LINE_WORDS - lane;
#endif
  if (lane == 0) {
    w->geometry = geometry;
    w->colors = sh;
    w->records = records;
    w->depths = depths;
    w->rectangles = rectangles;
    w->latest = ~0u;
#if USE_CULL_BLOCKS
    w->verdicts = verdicts;
#endif
  }
  barrier(CLK_LOCAL_MEM_FENCE);

  for (uint first = next_block(w, get_group_id(0) * LANES, step, count, lane),
            later;
       first < count; first = later) {
    later = next_block(w, first + step, step, count, lane);
#if USE_CULL_BLOCKS
    w->later = later; // In a register it takes 0.4 % more of the cycles.
#endif
    const uint i = first + lane;
#ifdef SCENE_IN_BLOCKS
    const uint next = min(later, count - 1) / LANES;
    const float ahead = w->geometry[next * (GEOMETRY_PLANES * LINE_WORDS) +
                                    lane + w->lines[0][lane]];
    __global const float *own_geometry =
        w->geometry + first * GEOMETRY_PLANES + lane;
    __global const float *own_sh = w->colors + first * sh_planes + lane;
#else
    __global const float *own_geometry = geometry;
    __global const float *own_sh = sh;
#endif
#if LENS_CLOSES
    uint own_key = CULLED + CULL_OUTSIDE;
    uint2 own_rectangle = (uint2)(0, 0);
#endif
    if (i < count) {
      uint2 rectangle;
      const uint key =
          project_one(w, own_geometry, own_sh, count, i, lane, effects,
                      &w->unread[lane], &w->stage.records[lane], &rectangle);
      w->depths[i] = key;
      ++w->found[key < CULLED ? 0 : 1 + min(key - CULLED, (uint)CULL_REASONS)]
                [lane];
      if (key < CULLED) {
        atomic_xchg(&w->latest, first);
        w->pairs[lane] = add_sat(w->pairs[lane], rectangle_tiles(rectangle));
        w->least_key[lane] = min(w->least_key[lane], key);
        w->greatest_key[lane] = max(w->greatest_key[lane], key);
      } else {
        rectangle = (uint2)(0, 0);
      }
      w->rectangles[i] = rectangle.x;
      w->rectangles[RECTANGLES(count) + i] = rectangle.y;
#if LENS_CLOSES
      own_key = key;
      own_rectangle = rectangle;
#endif
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (w->latest == first) {
      // All loads, then all stores: one by one, 3 and 6 % more cycles.
      uint words[RECORD_WORDS];
#pragma unroll
      for (uint k = 0; k < RECORD_WORDS; ++k)
        words[k] = w->stage.words[k * LANES + lane];
#pragma unroll
      for (uint k = 0; k < RECORD_WORDS; ++k)
        w->records[first * RECORD_WORDS + k * LANES + lane] = words[k];
    }
    barrier(CLK_LOCAL_MEM_FENCE);
#if LENS_CLOSES
    // Numbers of copies begin at whole lines; those of nobody are culled.
    const uint whole = WHOLE_LINES(count);
    if (i >= count)
      w->depths[i] = own_key;
    const float own_x = w->stage.records[lane].mean[0];
    for (uint copy = 1; copy < 3; ++copy) {
      const uint from = copy * whole + first;
      const float width = (float)w->view.size[0];
      uint2 rectangle = own_rectangle;
      uint key = own_key;
      if (key < CULLED)
        key = project_again(w, copy == 1 ? own_x + width : own_x - width, key,
                            from + lane, lane, effects, &w->stage.records[lane],
                            &rectangle);
      w->depths[from + lane] = key;
      if (key < CULLED) {
        ++w->found[0][lane];
        atomic_xchg(&w->latest, from);
        w->pairs[lane] = add_sat(w->pairs[lane], rectangle_tiles(rectangle));
      } else {
        rectangle = (uint2)(0, 0);
      }
      w->rectangles[from + lane] = rectangle.x;
      w->rectangles[RECTANGLES(count) + from + lane] = rectangle.y;
      barrier(CLK_LOCAL_MEM_FENCE);
      if (w->latest == from)
        for (uint k = 0; k < RECORD_WORDS; ++k)
          w->records[from * RECORD_WORDS + k * LANES + lane] =
              w->stage.words[k * LANES + lane];
      barrier(CLK_LOCAL_MEM_FENCE);
    }
#endif
#ifdef SCENE_IN_BLOCKS
    // Not before, so that nothing has waited for it.
    w->unread[lane] = as_uint(ahead);
#endif
#if USE_CULL_BLOCKS
    later = w->later;
#endif
  }
  splat_seen seen = {w->found[0][lane],
                     {0},
                     w->pairs[lane],
                     w->least_key[lane],
                     w->greatest_key[lane]};
#pragma unroll
  for (uint k = 0; k < CULL_REASONS; ++k)
    seen.culled[k] = w->found[1 + k][lane];
  items[get_global_id(0)] = seen;
}
