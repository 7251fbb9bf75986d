// `beside` is x and y less those of the ray at depth z.
#pragma once

static float2 crop_mean(VIEW_SPACE const splat_view *view,
                        CROP_SPACE const splat_crop *crop, float2 beside,
                        float z) {
  return (float2)(view->focal[0] * beside.x / z + crop->place[0],
                  view->focal[1] * beside.y / z + crop->place[1]);
}
