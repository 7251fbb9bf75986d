/* As blend.c, with each pixel in a line and no end before the last Gaussian. */
#include "kernel.h"

enum { GAUSSIANS = 24, WIDTH = 16, HEIGHT = 8 };
RESULT(float, 2048);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, WIDTH * HEIGHT) {
    const float x = (float)lane, y = (float)(base / WIDTH);
    float red = 0, green = 0, blue = 0, rest = 1;
    const float *g = ones;
#pragma nounroll
    for (uint n = 0; n < GAUSSIANS; ++n, g += 8) {
      const float dx = x - 20.0f * (g[0] - 1.1f);
      const float dy = y - 10.0f * (g[1] - 1.1f);
      const float power = 0.2f * (g[2] * dx * dx + g[3] * dy * dy);
      const float alpha = 0.9f * (g[4] - 0.9f) / (1.0f + power);
      if (alpha >= 0.1f) {
        red += g[5] * alpha * rest;
        green += g[6] * alpha * rest;
        blue += g[7] * alpha * rest;
        rest *= 1.0f - alpha;
      }
    }
    float *out = result + 16 * (base + lane);
    out[0] = red;
    out[1] = green;
    out[2] = blue;
    out[3] = rest;
  }
  return 0;
}
