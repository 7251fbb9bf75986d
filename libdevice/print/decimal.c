#include "decimal.h"

/* Numbers in base 10^9, most significant limb first, with the decimal point
   after limb[units]. The longest integer part is 2^1024 (35 limbs); the longest
   fraction is that of 2^-1074, one decimal digit for each bit. */
enum { LIMB_DIGITS = 9, UNITS = 36, LIMBS = UNITS + 1 + 1074 / 9 + 2 };
static const uint32_t LIMB = 1000000000;

struct fixed {
  int first, last; /* limbs in use */
  uint32_t limb[LIMBS];
};

static void multiply_by_power_of_two(struct fixed *f, int shift) {
  while (shift > 0) {
    const int step = shift < 29 ? shift : 29;
    uint32_t carry = 0;
    for (int i = f->last; i >= f->first; --i) {
      const uint64_t x = ((uint64_t)f->limb[i] << step) + carry;
      carry = (uint32_t)(x / LIMB);
      f->limb[i] = (uint32_t)(x % LIMB);
    }
    if (carry)
      f->limb[--f->first] = carry;
    shift -= step;
  }
}

static void divide_by_power_of_two(struct fixed *f, int shift) {
  while (shift > 0) {
    /* 10^9 is divisible by 2^9, so nothing is lost in a step of nine. */
    const int step = shift < 9 ? shift : 9;
    const uint32_t mask = (1u << step) - 1;
    uint32_t carry = 0;
    for (int i = f->first; i <= f->last; ++i) {
      const uint32_t rest = f->limb[i] & mask;
      f->limb[i] = (f->limb[i] >> step) + carry;
      carry = (LIMB >> step) * rest;
    }
    if (carry)
      f->limb[++f->last] = carry;
    if (f->limb[f->first] == 0 && f->first < f->last)
      ++f->first;
    shift -= step;
  }
}

void vx_decimal_of(struct vx_decimal *d, uint64_t mantissa, int exponent) {
  d->count = 0;
  d->point = 0;
  if (mantissa == 0)
    return;
  struct fixed f;
  f.first = UNITS - 1;
  f.last = UNITS;
  f.limb[UNITS - 1] = (uint32_t)(mantissa / LIMB);
  f.limb[UNITS] = (uint32_t)(mantissa % LIMB);
  multiply_by_power_of_two(&f, exponent);
  divide_by_power_of_two(&f, -exponent);

  d->point = (UNITS + 1 - f.first) * LIMB_DIGITS;
  for (int i = f.first; i <= f.last; ++i) {
    uint32_t power = LIMB / 10;
    for (int k = 0; k < LIMB_DIGITS; ++k, power /= 10) {
      const unsigned char digit = (unsigned char)(f.limb[i] / power % 10);
      if (d->count == 0 && digit == 0)
        --d->point;
      else
        d->digit[d->count++] = digit;
    }
  }
  while (d->digit[d->count - 1] == 0)
    --d->count;
}

void vx_decimal_round(struct vx_decimal *d, int keep) {
  if (keep >= d->count)
    return;
  if (keep < 0) {
    d->count = 0;
    return;
  }
  const int odd = keep > 0 && d->digit[keep - 1] % 2;
  const int next = d->digit[keep];
  /* Trailing zeros are never stored: more digits means more than half. */
  const int up = next > 5 || (next == 5 && (d->count > keep + 1 || odd));
  d->count = keep;
  if (up) {
    while (d->count > 0 && d->digit[d->count - 1] == 9)
      --d->count;
    if (d->count == 0) {
      d->digit[d->count++] = 1;
      ++d->point;
    } else {
      ++d->digit[d->count - 1];
    }
  } else {
    while (d->count > 0 && d->digit[d->count - 1] == 0)
      --d->count;
  }
}
