// A camera that moves while it exposes its picture (docs/cameras.md, "Rolling
// shutters"). A point is seen from where the camera is at the moment at which
// the point's own pixel is exposed: an equation, which Newton's method solves.

// Of a point in the axes of the camera's pose: what it is to the camera at its
// moment, how that changes in a whole exposure, and its place.
typedef struct {
  float3 p, rate;
  float2 at;
  float left;   // what the place's drift leaves of the shutter's way
  float moment; // from the pose's
} rolling_point;

// A picture that follows its shutter has no one moment for a point: the least
// share of the shutter's way that a point may fall behind it.
#define ROLLING_LEAST 0.25f
// Outside the picture time goes on, a whole exposure either way of the picture.
#define ROLLING_END 1.5f

static VIEW_SPACE const splat_shutter *
rolling_shutter_of(VIEW_SPACE const splat_lens *lens) {
  return (VIEW_SPACE const splat_shutter *)(lens + 1);
}

// `v` turned about the shutter's axis.
static float3 rolling_turned(VIEW_SPACE const splat_shutter *shutter,
                             float angle, float3 v) {
  const float3 axis =
      (float3)(shutter->axis[0], shutter->axis[1], shutter->axis[2]);
  const float half_sine = sin(0.5f * angle);
  const float3 across = cross(axis, v);
  return v + sin(angle) * across +
         2.0f * half_sine * half_sine * cross(axis, across);
}

// Along the way of the shutter, of a step on the picture.
static float rolling_by(VIEW_SPACE const splat_shutter *shutter, float2 step) {
  return shutter->moment[1] * step.x + shutter->moment[2] * step.y;
}

// What the near plane is compared with.
static float rolling_depth(const rolling_point *r) {
#ifdef LENS_BY_DISTANCE
  return sqrt(dot_in_order(r->p, r->p));
#else
  return r->p.z;
#endif
}

// How fast the place moves by the rows `j`, px a whole exposure.
static float2 rolling_drift(const rolling_point *r, lens_rows j) {
  return (float2)(dot_in_order(j.x, r->rate), dot_in_order(j.y, r->rate));
}

// False where the camera does not see it.
static bool rolling_at_moment(VIEW_SPACE const splat_view *view,
                              VIEW_SPACE const splat_lens *lens, float3 q,
                              rolling_point *r) {
  VIEW_SPACE const splat_shutter *shutter = rolling_shutter_of(lens);
  const float3 motion =
      (float3)(shutter->motion[0], shutter->motion[1], shutter->motion[2]);
  const float3 axis =
      (float3)(shutter->axis[0], shutter->axis[1], shutter->axis[2]);
  const float angle = -shutter->angle * r->moment;
  r->p = rolling_turned(shutter, angle, q - r->moment * motion);
  if (!lens_at(lens, r->p, &r->at))
    return false;
  r->rate = -(shutter->angle * cross(axis, r->p)) -
            rolling_turned(shutter, angle, motion);
  const lens_rows j = lens_rows_at(view, lens, r->p, false);
  r->left = 1.0f - rolling_by(shutter, rolling_drift(r, j));
  return true;
}

// The same at the moment that is the point's own.
static bool rolling_at(VIEW_SPACE const splat_view *view,
                       VIEW_SPACE const splat_lens *lens, float3 q,
                       rolling_point *r) {
  VIEW_SPACE const splat_shutter *shutter = rolling_shutter_of(lens);
  r->moment = 0.0f;
  for (uint n = 0; n < 12; ++n) {
    if (!rolling_at_moment(view, lens, q, r))
      return false;
    const float2 place =
        (float2)(view->focal[0] * r->at.x + view->center[0],
                 view->focal[1] * r->at.y + view->center[1]);
    const float behind =
        r->moment - (shutter->moment[0] + rolling_by(shutter, place));
    const float next = clamp(r->moment - behind / fmax(r->left, ROLLING_LEAST),
                             -ROLLING_END, ROLLING_END);
    const bool there = fabs(next - r->moment) < 1e-6f;
    r->moment = next;
    if (there)
      break;
  }
  return rolling_at_moment(view, lens, q, r) &&
         (fabs(r->moment) >= ROLLING_END || r->left >= ROLLING_LEAST);
}

// The rows by the point in the axes of the pose. A step of the point moves its
// moment, too, and with it the camera. The drift is that of the same rows: where
// they are held for a point far beside the picture, its own drift would be of
// another place.
static lens_rows rolling_rows(VIEW_SPACE const splat_view *view,
                              VIEW_SPACE const splat_lens *lens,
                              rolling_point r, bool hold) {
  VIEW_SPACE const splat_shutter *shutter = rolling_shutter_of(lens);
  lens_rows j = lens_rows_at(view, lens, r.p, hold);
  if (fabs(r.moment) < ROLLING_END) {
    const float2 drift = rolling_drift(&r, j);
    const float3 by =
        (shutter->moment[1] * j.x + shutter->moment[2] * j.y) /
        fmax(1.0f - rolling_by(shutter, drift), ROLLING_LEAST);
    j.x += drift.x * by;
    j.y += drift.y * by;
  }
  const float angle = shutter->angle * r.moment;
  j.x = rolling_turned(shutter, angle, j.x);
  j.y = rolling_turned(shutter, angle, j.y);
  return j;
}
