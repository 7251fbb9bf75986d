// e^power for power in [-80, 0] as the rasterizer's exponential units without a
// table find it (docs/lane-units.md#exponential-units): the same operations, so
// the same bits. EXP_DEGREE, 2 to 4, is defined. Numbers are those of
// isasim/raster/ExpUnits.h.
#pragma once

// Degree of the polynomial of the exponential unit, 2 to 4.
#pragma vorion choice optional uint EXP_DEGREE

#define LOG2E 0x1.715476p0f

static float falloff(float power) {
  const float y = power * -LOG2E;
  const int whole = (int)y;
  const float g = y - (float)whole;
#if EXP_DEGREE == 2
  const float sum = 0x1.5beba0p-3f * g + -0x1.56fae8p-1f;
#elif EXP_DEGREE == 3
  const float sum =
      (-0x1.4095eap-5f * g + 0x1.d82da4p-3f) * g + -0x1.62020ap-1f;
#elif EXP_DEGREE == 4
  const float sum =
      ((0x1.bc31dap-8f * g + -0x1.b338d2p-5f) * g + 0x1.ea4d86p-3f) * g +
      -0x1.62d838p-1f;
#endif
  return as_float(as_int(sum * g + 1.0f) - (whole << 23));
}
