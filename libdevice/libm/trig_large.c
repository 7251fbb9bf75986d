/* The argument is reduced with as many bits of 2/pi as it needs (Payne and
   Hanek, "Radian reduction for trigonometric functions", SIGNUM 1983), and the
   series are summed in double, in software: rare arguments may be slow. */
#include "trig_large.h"

#include <stdint.h>

/* 2/pi in words, after 32 bits of 0 for windows that begin above the point. */
static const uint32_t two_over_pi[] = {0,          0xa2f9836e, 0x4e441529,
                                       0xfc2757d1, 0xf534ddc0, 0xdb629599,
                                       0x3c439041, 0xfe5163ab};

static uint32_t window(uint32_t bit) {
  const uint32_t *words = two_over_pi + bit / 32;
  const uint64_t pair = (uint64_t)words[0] << 32 | words[1];
  return (uint32_t)(pair << bit % 32 >> 32);
}

/* x = quadrant * pi/2 + the result, which lies in [-pi/4, pi/4]. */
static double reduce(float x, uint32_t *quadrant) {
  const uint32_t bits = __builtin_bit_cast(uint32_t, x);
  const uint32_t significand = (bits & 0x7fffff) | 0x800000;
  /* abs(x) = significand * 2^e, -8 <= e <= 104. Bits of 2/pi before the window
     only add multiples of 4; those after it change less than 2^-70, where no
     float comes nearer to a multiple of pi/2 than about 2^-30. */
  const uint32_t e_plus_30 = (bits >> 23 & 0xff) - 150 + 30;
  const uint64_t low = (uint64_t)significand * window(e_plus_30 + 64);
  const uint64_t middle =
      (uint64_t)significand * window(e_plus_30 + 32) + (low >> 32);
  const uint32_t high =
      significand * window(e_plus_30) + (uint32_t)(middle >> 32);
  /* Two bits of quadrant, then the fraction, to the nearest. */
  const uint64_t product = (uint64_t)high << 32 | (uint32_t)middle;
  const int64_t fraction = (int64_t)(product << 2 | (uint32_t)low >> 30);
  *quadrant = (high >> 30) + (fraction < 0);
  const double angle = (double)fraction * 0x1.921fb54442d18p-64; /* pi/2 */
  if (bits >> 31) {
    *quadrant = -*quadrant;
    return -angle;
  }
  return angle;
}

/* Taylor's series; what is left out is below 2^-44 of the result. */
static double sine(double a) {
  const double s = a * a;
  double sum = 1;
  for (int k = 14; k != 0; k -= 2)
    sum = 1 - sum * s / (double)(k * (k + 1));
  return a * sum;
}
static double cosine(double a) {
  const double s = a * a;
  double sum = 1;
  for (int k = 15; k > 0; k -= 2)
    sum = 1 - sum * s / (double)(k * (k + 1));
  return sum;
}

static float sine_of_quadrant(double a, uint32_t quadrant) {
  const double value = quadrant & 1 ? cosine(a) : sine(a);
  return (float)(quadrant & 2 ? -value : value);
}

float large_sinf(float x) {
  uint32_t quadrant;
  const double a = reduce(x, &quadrant);
  return sine_of_quadrant(a, quadrant);
}

float large_cosf(float x) {
  uint32_t quadrant;
  const double a = reduce(x, &quadrant);
  return sine_of_quadrant(a, quadrant + 1);
}

float large_tanf(float x) {
  uint32_t quadrant;
  const double a = reduce(x, &quadrant);
  const double s = sine(a), c = cosine(a);
  return (float)(quadrant & 1 ? -c / s : s / c);
}
