// Where there is a background (effects/Background.cpp):
// from (r, g, b, transmittance) to the picture: the background shows through
// what is left, and the fourth channel becomes alpha. A work-item has a channel
// of four pixels rather than a pixel, so that a warp reads and writes whole
// lines: the cache fetches a line of which it gets a part.

// Of the value `own` of a channel.
static float resolved(float own, float transmittance, float background,
                      int is_alpha) {
  // 1 - T is 1 + T * -1, to the last bit.
  return select(own, 1.0f, is_alpha) + transmittance * background;
}

// As many work-items as pixels, or more; a multiple of four in a group.
__kernel void resolve(__global const float *pixels, __global float *picture,
                      uint count, float red, float green, float blue,
                      uint effects) {
  const uint channel = get_local_id(0) % 4;
  const int is_alpha = channel == 3 ? -1 : 0;
  const float background = channel == 3        ? -1.0f
                           : !(USE_BACKGROUND) ? 0.0f
                           : channel == 0      ? red
                           : channel == 1 ? green
                                          : blue;
  const uint step = get_local_size(0);
  const uint begin = 4 * step * get_group_id(0);
  const uint i = begin + get_local_id(0);
  if (begin + 4 * step <= 4 * count) {
    float own[4], transmittance[4];
#pragma unroll
    for (uint k = 0; k < 4; ++k) {
      own[k] = pixels[i + k * step];
      transmittance[k] = pixels[i + k * step + 3 - channel];
    }
#pragma unroll
    for (uint k = 0; k < 4; ++k)
      picture[i + k * step] =
          resolved(own[k], transmittance[k], background, is_alpha);
    return;
  }
  for (uint place = i; place < 4 * count; place += step)
    picture[place] = resolved(pixels[place], pixels[place + 3 - channel],
                              background, is_alpha);
}
