// e^power for power in [-80, 0], within 1.1 ulp: what is left of exp() when
// nothing can overflow, underflow or be NaN. A third of the instructions.
#pragma once

static float falloff(float power) {
  // Adding 1.5 * 2^23 rounds to a whole number, which the low bits then hold.
  const float shift = 12582912.0f;
  const float shifted = fma(power, 1.44269504f, shift);
  const float n = shifted - shift;
  // power - n ln 2 in two steps, the first of them exact.
  const float r = fma(n, -0x1.7f7d1cp-20f, fma(n, -0x1.62e4p-1f, power));
  // (e^r - 1 - r) / r^2, interpolated at Chebyshev's points of |r| <= ln 2 / 2.
  float q = fma(r, 0x1.6d110ap-10f, 0x1.120b6ep-7f);
  q = fma(r, q, 0x1.55551ap-5f);
  q = fma(r, q, 0x1.5554dcp-3f);
  q = fma(r, q, 0.5f);
  const float e = 1.0f + fma(r * r, q, r);
  return as_float(as_uint(e) + (as_uint(shifted) << 23));
}
