/* Blends 24 Gaussians into 16 x 8 pixels, front to back: a lane has a pixel,
   passes over what it hardly sees, and stops when it sees nothing more. */
#include "kernel.h"

enum { GAUSSIANS = 24, WIDTH = 16, HEIGHT = 8 };
RESULT(float, 512);

/* exp(x) for x <= 0: the bits of a float are nearly its logarithm. */
static float exponential(float x) {
  const float y = x * 12102203.0f + 1064986823.0f;
  union {
    int i;
    float f;
  } both = {y > 0 ? (int)y : 0};
  return both.f;
}

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, WIDTH * HEIGHT) {
    const float x = (float)lane, y = (float)(base / WIDTH);
    float red = 0, green = 0, blue = 0, rest = 1;
    const float *g = ones;
#pragma nounroll
    for (uint n = 0; n < GAUSSIANS; ++n, g += 8) {
      const float dx = x - 20.0f * (g[0] - 1.1f),
                  dy = y - 10.0f * (g[1] - 1.1f);
      const float power =
          -0.06f * (g[2] * dx * dx + g[3] * dy * dy) - 0.03f * dx * dy;
      const float alpha = 0.9f * (g[4] - 0.9f) * exponential(power);
      if (alpha < 1.0f / 255)
        continue;
      const float after = rest * (1 - alpha);
      if (after < 0.01f)
        break;
      red += g[5] * alpha * rest;
      green += g[6] * alpha * rest;
      blue += g[7] * alpha * rest;
      rest = after;
    }
    float *out = result + 4 * (base + lane);
    out[0] = red;
    out[1] = green;
    out[2] = blue;
    out[3] = rest;
  }
  return 0;
}
