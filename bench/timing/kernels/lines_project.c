/* As project.c, with each Gaussian in a line and none behind the camera. */
#include "kernel.h"

RESULT(float, 4096);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 256) {
    const float *in = ones + 16 * (base + lane);
    float *out = result + 16 * (base + lane);
    const float x = in[0] - 1.5f, y = in[1] - 1.5f, z = 2.0f * in[2];
    const float focal = 500.0f, inverse = 1.0f / z;
    const float jx = focal * inverse, kx = -jx * x * inverse,
                ky = -jx * y * inverse;
    const float a = in[3] * 0.01f, b = in[4] * 0.01f, c = in[5] * 0.01f;
    const float aa = a * a, bb = b * b, cc = c * c;
    const float xx = jx * jx * aa + kx * kx * cc + 0.3f;
    const float xy = kx * ky * cc;
    const float yy = jx * jx * bb + ky * ky * cc + 0.3f;
    const float determinant = xx * yy - xy * xy;
    const float middle = 0.5f * (xx + yy);
    const float square = middle * middle - determinant;
    const float root = __builtin_sqrtf(square > 0.1f ? square : 0.1f);
    out[0] = focal * x * inverse + 256.0f;
    out[1] = focal * y * inverse + 256.0f;
    out[2] = yy / determinant;
    out[3] = -xy / determinant;
    out[4] = xx / determinant;
    out[5] = (float)(int)(3.0f * __builtin_sqrtf(middle + root) + 1.0f);
  }
  return 0;
}
