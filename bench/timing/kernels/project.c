/* Gaussians to a picture: position, covariance in the picture, its inverse and
   the radius of its box, with divisions and square roots. Some are behind the
   camera. */
#include "kernel.h"

enum { COUNT = 256 };
RESULT(float, 1536);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, COUNT) {
    const uint i = base + lane;
    const float *scale = ones + COUNT * 3;
    const float x = ones[i] - 1.5f, y = ones[COUNT + i] - 1.5f;
    const float z = 4.0f * ones[2 * COUNT + i] - 4.5f;
    float *out = result + i;
    if (z < 0.2f) {
      for (uint n = 0; n < 6; ++n)
        out[n * COUNT] = 0;
      continue;
    }
    const float inverse = 1.0f / z, focal = 500.0f;
    const float jx = focal * inverse, kx = -jx * x * inverse,
                ky = -jx * y * inverse;
    const float a = scale[i] * 0.01f, b = scale[COUNT + i] * 0.01f,
                c = scale[2 * COUNT + i] * 0.01f;
    const float aa = a * a, bb = b * b, cc = c * c;
    const float xx = jx * jx * aa + kx * kx * cc + 0.3f;
    const float xy = kx * ky * cc;
    const float yy = jx * jx * bb + ky * ky * cc + 0.3f;
    const float determinant = xx * yy - xy * xy;
    const float middle = 0.5f * (xx + yy);
    const float square = middle * middle - determinant;
    const float root = __builtin_sqrtf(square > 0.1f ? square : 0.1f);
    out[0] = focal * x * inverse + 256.0f;
    out[COUNT] = focal * y * inverse + 256.0f;
    out[2 * COUNT] = yy / determinant;
    out[3 * COUNT] = -xy / determinant;
    out[4 * COUNT] = xx / determinant;
    out[5 * COUNT] = (float)(int)(3.0f * __builtin_sqrtf(middle + root) + 1.0f);
  }
  return 0;
}
