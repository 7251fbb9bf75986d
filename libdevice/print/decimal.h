/* The decimal digits of a binary floating-point number, exactly. */
#ifndef VX_DECIMAL_H
#define VX_DECIMAL_H

#include <stdint.h>

/* A double has at most 767 significant digits; limbs of nine digits may add
   eight zeros at either end. */
enum { VX_MAX_DIGITS = 800 };

/* The number 0.d1d2d3... * 10^point; digits are values 0 to 9, the first is not
   0 unless the number is, which has no digits at all. */
struct vx_decimal {
  int count;
  int point;
  unsigned char digit[VX_MAX_DIGITS];
};

/* d = mantissa * 2^exponent; mantissa below 2^53, exponent -1074 to 971. */
void vx_decimal_of(struct vx_decimal *d, uint64_t mantissa, int exponent);

/* Rounds to the first keep digits, half to even; with keep below 0 the number
   becomes 0. Digits beyond the last stay implied zeros. */
void vx_decimal_round(struct vx_decimal *d, int keep);

#endif
