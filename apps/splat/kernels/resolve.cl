// Where there is a background (effects/Background.cpp):
// from (r, g, b, transmittance) to the picture: the background shows through
// what is left, and the fourth channel becomes alpha. A work-item has one
// channel of many pixels, so that a warp reads and writes whole lines.

// A background (effects/Background.cpp).
#pragma vorion choice effect USE_BACKGROUND

#define LANES 16
// Lines that a group has in flight.
#define BATCH 4

// Of the value `own` of a channel.
static float resolved(float own, float transmittance, float background,
                      int is_alpha) {
  // 1 - T is 1 + T * -1, to the last bit.
  return select(own, 1.0f, is_alpha) + transmittance * background;
}

// `values` is four times the pixels.
__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
resolve(__global const float *pixels, __global float *picture, uint values,
        float red, float green, float blue, uint effects) {
  const uint channel = get_local_id(0) % 4;
  const int is_alpha = channel == 3 ? -1 : 0;
  const float background = channel == 3        ? -1.0f
                           : !(USE_BACKGROUND) ? 0.0f
                           : channel == 0      ? red
                           : channel == 1 ? green
                                          : blue;
  const uint step = get_num_groups(0) * LANES * BATCH;
  uint i = get_group_id(0) * LANES * BATCH + get_local_id(0);
  for (; i + (BATCH - 1) * LANES < values; i += step) {
    __global const float *from = pixels + i;
    float own[BATCH], transmittance[BATCH];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k) {
      own[k] = from[k * LANES];
      transmittance[k] = from[k * LANES + 3 - channel];
    }
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      picture[i + k * LANES] =
          resolved(own[k], transmittance[k], background, is_alpha);
  }
  for (; i < values; i += LANES)
    picture[i] =
        resolved(pixels[i], pixels[i + 3 - channel], background, is_alpha);
}
