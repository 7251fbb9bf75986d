// Where the picture is a window beside the principal point (effects/Crop.cpp):
// how far beside the ray through the picture's middle a point is, rounded once.
// Beside the axis it would be far, and f x / z would cancel against the
// principal point.
static float beside_middle(__local const splat_view *view,
                           __local const splat_crop *crop, int axis, float x,
                           float y, float z) {
  const float part[3] = {x, y, z};
  float2 beside = (float2)(0.0f, 0.0f);
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float2 from = two_sum(part[k], -view->position[k]);
    const float2 d = two_sum(from.x, from.y - view->position_low[k]);
    const float high = crop->across[axis][k] * d.x;
    const float low = fma(crop->across[axis][k], d.x, -high) +
                      crop->across_low[axis][k] * d.x +
                      crop->across[axis][k] * d.y;
    const float2 next = two_sum(beside.x, high);
    beside = (float2)(next.x, beside.y + (next.y + low));
  }
  return beside.x + beside.y;
}
