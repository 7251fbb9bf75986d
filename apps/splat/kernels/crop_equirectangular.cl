// `beside` is the point's part to the right of the ray, level, and that down, at
// right angles to the ray. `ray` has the sines and cosines of the ray's longitude
// and latitude. The place is the one nearest to the ray's.
#pragma once

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
