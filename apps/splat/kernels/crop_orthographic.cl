// `beside` is x and y less those of the ray.
static float2 crop_mean(__local const splat_view *view,
                        __local const splat_lens *lens,
                        __local const splat_crop *crop, float2 beside,
                        float3 p) {
  return (float2)(view->focal[0] * beside.x + crop->place[0],
                  view->focal[1] * beside.y + crop->place[1]);
}
