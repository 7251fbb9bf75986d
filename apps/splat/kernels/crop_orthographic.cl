// `beside` is x and y less those of the ray.
#pragma once

static float2 crop_mean(VIEW_SPACE const splat_view *view,
                        VIEW_SPACE const splat_lens *lens,
                        CROP_SPACE const splat_crop *crop, float2 beside,
                        float3 p) {
  return (float2)(view->focal[0] * beside.x + crop->place[0],
                  view->focal[1] * beside.y + crop->place[1]);
}
