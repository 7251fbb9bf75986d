// The full sphere: longitude to the right and latitude down, both from straight
// ahead. Depth is the distance from the camera.
#pragma once

#include "covariance.cl"
#include "crop.cl"
#include "layout.h"

#define LENS_BY_DISTANCE 1
#define LENS_CLOSES 1
#define LENS_HOLDS true

// The distance from the vertical axis with its direction in x and z, that from
// the camera, and cosine and sine of the latitude at which the Jacobian is
// taken: no nearer to a pole than the middle of the picture's last row.
typedef struct {
  float level, distance, cosine, sine;
  float2 out;
  bool held;
} lens_globe;

static lens_globe lens_globe_of(VIEW_SPACE const splat_lens *lens, float3 p,
                                bool hold) {
  lens_globe g;
  const float squared = p.x * p.x + p.z * p.z;
  g.level = sqrt(squared);
  g.distance = sqrt(squared + p.y * p.y);
  g.cosine = g.level / g.distance;
  g.sine = p.y / g.distance;
  g.held = hold && g.cosine < lens->limit;
  if (g.held) {
    g.cosine = lens->limit;
    g.sine = copysign(sqrt(1.0f - lens->limit * lens->limit), p.y);
  }
  g.out = g.level > 0.0f ? p.xz / g.level : (float2)(0.0f, 1.0f);
  return g;
}

static bool lens_at(VIEW_SPACE const splat_lens *lens, float3 p, float2 *at) {
  *at = (float2)(atan2(p.x, p.z), atan2(p.y, sqrt(p.x * p.x + p.z * p.z)));
  return true;
}

static bool lens_is_held(VIEW_SPACE const splat_view *view,
                         VIEW_SPACE const splat_lens *lens, float3 p,
                         bool hold) {
  return lens_globe_of(lens, p, hold).held;
}

static lens_rows lens_jacobian(VIEW_SPACE const splat_view *view,
                               VIEW_SPACE const splat_lens *lens, float3 p,
                               bool hold) {
  const lens_globe g = lens_globe_of(lens, p, hold);
  const float turn = 1.0f / (g.cosine * g.distance);
  const lens_rows j = {(float3)(g.out.y * turn, 0.0f, -g.out.x * turn),
                       (float3)(-g.sine * g.out.x, g.cosine,
                                -g.sine * g.out.y) /
                           g.distance};
  return j;
}

static float3 lens_curvature(VIEW_SPACE const splat_view *view,
                             VIEW_SPACE const splat_lens *lens, float3 p,
                             lens_rows by, bool hold) {
  const lens_globe g = lens_globe_of(lens, p, hold);
  // Straight up or down a longitude has no derivative.
  if (!(g.level > 0.0f))
    return (float3)(0.0f, 0.0f, 0.0f);
  // In the frame of out, across (to the right) and down, times distances: rows
  // by columns, without what is 0.
  const float2 e = g.out, t = (float2)(g.out.y, -g.out.x);
  const float turn_out = dot(by.x.xz, e), turn_across = dot(by.x.xz, t);
  const float rise_out = dot(by.y.xz, e), rise_across = dot(by.y.xz, t);
  const float rise_down = by.y.y;
  const float c = g.cosine, s = g.sine, squared = g.distance * g.distance;
  float by_out, by_down;
  if (g.held) {
    // Rows as at the limit, which shrink with the distance alone.
    const float all =
        -(turn_across / c + c * rise_down - s * rise_out) / squared;
    by_out = all * (g.level / g.distance);
    by_down = all * (p.y / g.distance);
  } else {
    by_out = (-turn_across / (c * c) + (s * s - c * c) * rise_down +
              2.0f * s * c * rise_out) /
             squared;
    by_down = (-2.0f * s * c * rise_down - (c * c - s * s) * rise_out) /
              squared;
  }
  // The frame turns with the longitude.
  const float by_across =
      -(turn_out / c + s * rise_across) / (g.level * g.distance);
  return (float3)(by_out * e.x + by_across * t.x, by_down,
                  by_out * e.y + by_across * t.y);
}

// `beside` is the point's part to the right of the ray, level, and that down, at
// right angles to the ray. `ray` has the sines and cosines of the ray's longitude
// and latitude. The place is the one nearest to the ray's.
static float2 crop_mean(VIEW_SPACE const splat_view *view,
                        VIEW_SPACE const splat_lens *lens,
                        CROP_SPACE const splat_crop *crop, float2 beside,
                        float3 p) {
  const float sine = crop->ray[2], cosine = crop->ray[3];
  const float along = p.x * crop->ray[0] + p.z * crop->ray[1];
  const float level = sqrt(along * along + beside.x * beside.x);
  // level - along
  const float bend = along > 0.0f ? beside.x * beside.x / (level + along)
                                  : level - along;
  return (float2)(view->focal[0] * atan2(beside.x, along) + crop->place[0],
                  view->focal[1] * atan2(beside.y - bend * sine,
                                         level * cosine + p.y * sine) +
                      crop->place[1]);
}
