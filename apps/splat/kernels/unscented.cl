// The unscented transform (Wu et al. 2025, "3DGUT", with alpha 1, beta 2, kappa
// 0): a Gaussian goes through the camera as seven of its points, the mean and
// sqrt(3) deviations along each axis either way, with weights 0 and 1/6 for the
// mean on the picture and 2 and 1/6 for the covariance.
#define UNSCENTED_STEP 1.7320508f    // root of 3
#define UNSCENTED_WEIGHT 0.40824829f // root of 1/6

typedef struct {
  float2 shift;  // from the place of the mean to the mean on the picture
  float2 off[7]; // from there to the points' places and, last, to the mean's
                 // own, times the root of the weight
} unscented_points;

// From the mean to the points, along each axis.
typedef struct {
  float3 along[3];
} unscented_steps;

// `a` are axes as long as the deviations.
static unscented_steps unscented_steps_of(camera_axes a) {
  const unscented_steps steps = {
      {(float3)(a.x.x, a.y.x, a.z.x) * UNSCENTED_STEP,
       (float3)(a.x.y, a.y.y, a.z.y) * UNSCENTED_STEP,
       (float3)(a.x.z, a.y.z, a.z.z) * UNSCENTED_STEP}};
  return steps;
}

// Point `n` of six.
static float3 unscented_point(float3 p, const unscented_steps *steps, uint n) {
  return n % 2 == 0 ? p + steps->along[n / 2] : p - steps->along[n / 2];
}

// Those of the mean `p`, whose own place is `at`; false where the camera does not
// see one of them.
static bool unscented_points_of(VIEW_SPACE const splat_view *view,
                                VIEW_SPACE const splat_lens *lens, float3 p,
                                float2 at, const unscented_steps *steps,
                                unscented_points *points) {
  const float2 focal = (float2)(view->focal[0], view->focal[1]);
  float2 sum = (float2)(0.0f, 0.0f);
  for (uint n = 0; n < 6; ++n) {
    const float3 q = unscented_point(p, steps, n);
    float2 there;
#if !USE_FISHEYE && !USE_ORTHOGRAPHIC && !USE_EQUIRECTANGULAR
    if (!(KEEP_DEPTH(q.z)))
      return false;
#endif
#if USE_ROLLING_SHUTTER
    rolling_point own;
    if (!rolling_at(view, lens, q, &own))
      return false;
    there = own.at;
#else
    if (!lens_at(lens, q, &there))
      return false;
#endif
    points->off[n] = focal * lens_difference(there, at);
    sum += points->off[n];
  }
  points->shift = sum / 6.0f;
  for (uint n = 0; n < 6; ++n)
    points->off[n] = (points->off[n] - points->shift) * UNSCENTED_WEIGHT;
  points->off[6] = -points->shift * 1.4142135f;
  return true;
}

static screen_covariance
unscented_covariance(const unscented_points *points) {
  float xx = 0.0f, xy = 0.0f, yy = 0.0f, det = 0.0f;
  for (uint n = 0; n < 7; ++n) {
    const float2 off = points->off[n];
    xx += off.x * off.x;
    xy += off.x * off.y;
    yy += off.y * off.y;
    for (uint m = 0; m < n; ++m) {
      const float minor =
          points->off[m].x * off.y - points->off[m].y * off.x;
      det += minor * minor;
    }
  }
  screen_covariance s;
  s.xx = xx + DILATION;
  s.xy = xy;
  s.yy = yy + DILATION;
  s.det_sharp = det;
  s.det = det + DILATION * (xx + yy) + DILATION * DILATION;
  return s;
}
