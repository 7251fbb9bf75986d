// The unscented transform (Wu et al. 2025, "3DGUT", with alpha 1, beta 2, kappa
// 0): a Gaussian goes through the camera as seven of its points, the mean and
// sqrt(3) deviations along each axis either way, with weights 0 and 1/6 for the
// mean on the picture and 2 and 1/6 for the covariance.

// The covariance, and in `shift` how far the mean on the picture is from that
// point's own place; false where the camera does not see one of the points.
static bool unscented_covariance(VIEW_SPACE const splat_view *view,
                                 VIEW_SPACE const splat_lens *lens, float3 p,
                                 float2 at, camera_axes a,
                                 screen_covariance *s, float2 *shift) {
  const float step = 1.7320508f;
  const float3 axis[3] = {(float3)(a.x.x, a.y.x, a.z.x) * step,
                          (float3)(a.x.y, a.y.y, a.z.y) * step,
                          (float3)(a.x.z, a.y.z, a.z.z) * step};
  const float2 focal = (float2)(view->focal[0], view->focal[1]);
  float2 off[7];
  float2 sum = (float2)(0.0f, 0.0f);
  for (uint n = 0; n < 6; ++n) {
    const float3 q = n % 2 == 0 ? p + axis[n / 2] : p - axis[n / 2];
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
    off[n] = focal * lens_difference(there, at);
    sum += off[n];
  }
  *shift = sum / 6.0f;
  for (uint n = 0; n < 6; ++n)
    off[n] = (off[n] - *shift) * 0.40824829f; // the root of 1/6
  off[6] = -*shift * 1.4142135f;
  float xx = 0.0f, xy = 0.0f, yy = 0.0f, det = 0.0f;
  for (uint n = 0; n < 7; ++n) {
    xx += off[n].x * off[n].x;
    xy += off[n].x * off[n].y;
    yy += off[n].y * off[n].y;
    for (uint m = 0; m < n; ++m) {
      const float minor = off[m].x * off[n].y - off[m].y * off[n].x;
      det += minor * minor;
    }
  }
  s->xx = xx + DILATION;
  s->xy = xy;
  s->yy = yy + DILATION;
  s->det_sharp = det;
  s->det = det + DILATION * (xx + yy) + DILATION * DILATION;
  return true;
}
