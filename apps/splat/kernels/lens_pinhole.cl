// A pinhole, for the unscented transform and rolling shutters.
#define LENS_HOLDS (USE_FIELD_OF_VIEW != 0)

static bool lens_at(VIEW_SPACE const splat_lens *lens, float3 p, float2 *at) {
  *at = (float2)(p.x / p.z, p.y / p.z);
  return p.z > 0.0f;
}

static lens_rows lens_jacobian(VIEW_SPACE const splat_view *view,
                               VIEW_SPACE const splat_lens *lens, float3 p,
                               bool hold) {
  float2 ratio = (float2)(p.x / p.z, p.y / p.z);
  if (hold)
    ratio = (float2)(clamp(ratio.x, view->ratio_low[0], view->ratio_high[0]),
                     clamp(ratio.y, view->ratio_low[1], view->ratio_high[1]));
  const lens_rows j = {(float3)(1.0f, 0.0f, -ratio.x) / p.z,
                       (float3)(0.0f, 1.0f, -ratio.y) / p.z};
  return j;
}
