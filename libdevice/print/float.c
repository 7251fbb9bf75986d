#include "decimal.h"
#include "format_internal.h"

enum { FRACTION_BITS = 52, EXPONENT_BIAS = 1023, EXPONENT_MAX = 0x7ff };

/* Text of a finite number without its sign. It can be long (%f of 1e308), so it
   is walked twice, once to measure and once to write, rather than stored. */
struct layout {
  const struct vx_decimal *decimal;
  int first;    /* exponent of the first digit shown */
  int whole;    /* digits before the point, at least 1 */
  int fraction; /* digits after it */
  int point;    /* show the point */
  char exponent[7];
  int exponent_size;
};

static int digit_at(const struct vx_decimal *d, int index) {
  return index >= 0 && index < d->count ? d->digit[index] : 0;
}

static void put_exponent(struct layout *l, char letter, int exponent,
                         int least_digits) {
  char *at = l->exponent;
  *at++ = letter;
  *at++ = exponent < 0 ? '-' : '+';
  unsigned rest = (unsigned)(exponent < 0 ? -exponent : exponent);
  char digits[4];
  int size = 0;
  do {
    digits[size++] = (char)('0' + rest % 10);
    rest /= 10;
  } while (rest || size < least_digits);
  while (size)
    *at++ = digits[--size];
  l->exponent_size = (int)(at - l->exponent);
}

/* Lays out d, already rounded, in fixed (%f) or scientific (%e) form. */
static struct layout lay_out(const struct vx_decimal *d, int scientific,
                             int fraction, const struct vx_spec *spec) {
  struct layout l = {.decimal = d, .fraction = fraction};
  l.point = fraction > 0 || spec->alternate;
  if (scientific) {
    const int exponent = d->count ? d->point - 1 : 0;
    l.first = exponent;
    l.whole = 1;
    put_exponent(&l, spec->upper ? 'E' : 'e', exponent, 2);
  } else {
    l.first = d->count && d->point > 0 ? d->point - 1 : 0;
    l.whole = l.first + 1;
  }
  return l;
}

static void put_layout(struct vx_text *text, const struct vx_spec *spec,
                       const struct layout *l, const char *sign) {
  const int size = l->whole + l->point + l->fraction + l->exponent_size;
  const int used = size + (sign[0] != 0);
  const int padding = spec->width > used ? spec->width - used : 0;
  const int zeros = spec->zero && !spec->left;
  if (!spec->left && !zeros)
    vx_put_repeated(text, ' ', padding);
  if (sign[0])
    vx_put(text, sign[0]);
  if (zeros)
    vx_put_repeated(text, '0', padding);
  for (int i = 0; i < l->whole + l->fraction; ++i) {
    if (i == l->whole)
      vx_put(text, '.');
    /* The digit of weight 10^(first - i) stands at point - 1 - weight. */
    vx_put(text, (char)('0' + digit_at(l->decimal, l->decimal->point - 1 -
                                                       (l->first - i))));
  }
  if (l->point && l->fraction == 0)
    vx_put(text, '.');
  vx_put_bytes(text, l->exponent, l->exponent_size);
  if (spec->left)
    vx_put_repeated(text, ' ', padding);
}

static void put_decimal(struct vx_text *text, const struct vx_spec *spec,
                        uint64_t mantissa, int exponent, const char *sign) {
  struct vx_decimal d;
  vx_decimal_of(&d, mantissa, exponent);
  int precision = spec->precision < 0 ? 6 : spec->precision;
  int scientific = spec->letter == 'e';
  if (spec->letter == 'g') {
    if (precision == 0)
      precision = 1;
    vx_decimal_round(&d, precision);
    const int x = d.count ? d.point - 1 : 0;
    scientific = x < -4 || x >= precision;
    precision = scientific ? precision - 1 : precision - 1 - x;
    if (!spec->alternate) { /* drop the fraction's trailing zeros */
      const int last = scientific ? d.count - 1 : d.count - d.point;
      if (precision > last)
        precision = last > 0 ? last : 0;
    }
  } else {
    vx_decimal_round(&d, scientific ? precision + 1 : d.point + precision);
  }
  const struct layout l = lay_out(&d, scientific, precision, spec);
  put_layout(text, spec, &l, sign);
}

static void put_hexadecimal(struct vx_text *text, const struct vx_spec *spec,
                            uint64_t mantissa, int exponent, const char *sign) {
  /* One digit before the point: shift the leading bit to FRACTION_BITS. */
  const uint64_t one = (uint64_t)1 << FRACTION_BITS;
  exponent += FRACTION_BITS;
  while (mantissa && !(mantissa & one)) {
    mantissa <<= 1;
    --exponent;
  }
  if (!mantissa)
    exponent = 0;
  int digits = FRACTION_BITS / 4;
  if (spec->precision < 0) {
    while (digits && !(mantissa >> (FRACTION_BITS - 4 * digits) & 15))
      --digits;
  } else if (spec->precision < digits) {
    digits = spec->precision;
    const uint64_t unit = one >> (4 * digits), rest = mantissa & (unit - 1);
    mantissa -= rest;
    if (rest > unit / 2 || (rest == unit / 2 && mantissa & unit))
      mantissa += unit;
  }
  const char *letters = spec->upper ? "0123456789ABCDEF" : "0123456789abcdef";
  char body[2 + FRACTION_BITS / 4];
  int size = 0;
  body[size++] = letters[mantissa >> FRACTION_BITS];
  const int padding = spec->precision > digits ? spec->precision - digits : 0;
  if (digits || padding || spec->alternate)
    body[size++] = '.';
  for (int i = 1; i <= digits; ++i)
    body[size++] = letters[mantissa >> (FRACTION_BITS - 4 * i) & 15];
  struct layout tail = {.decimal = 0};
  put_exponent(&tail, spec->upper ? 'P' : 'p', exponent, 1);

  const int used = (sign[0] != 0) + 2 + size + padding + tail.exponent_size;
  const int fill = spec->width > used ? spec->width - used : 0;
  const int zeros = spec->zero && !spec->left;
  if (!spec->left && !zeros)
    vx_put_repeated(text, ' ', fill);
  if (sign[0])
    vx_put(text, sign[0]);
  vx_put_bytes(text, spec->upper ? "0X" : "0x", 2);
  if (zeros)
    vx_put_repeated(text, '0', fill);
  vx_put_bytes(text, body, size);
  vx_put_repeated(text, '0', padding);
  vx_put_bytes(text, tail.exponent, tail.exponent_size);
  if (spec->left)
    vx_put_repeated(text, ' ', fill);
}

void vx_format_double(struct vx_text *text, const struct vx_spec *spec,
                      uint64_t bits) {
  const int negative = (int)(bits >> 63);
  const int biased = (int)(bits >> FRACTION_BITS & EXPONENT_MAX);
  const uint64_t fraction = bits & (((uint64_t)1 << FRACTION_BITS) - 1);
  if (biased == EXPONENT_MAX) {
    struct vx_spec plain = *spec;
    plain.zero = 0; /* zeros before "inf" would read as a number */
    const char *name = fraction ? (spec->upper ? "NAN" : "nan")
                                : (spec->upper ? "INF" : "inf");
    /* A NaN is printed without its sign, as OpenCL's conformance test asks. */
    vx_put_padded(text, &plain, vx_sign(spec, negative && !fraction), 0, name,
                  3);
    return;
  }
  const uint64_t mantissa =
      biased ? fraction | (uint64_t)1 << FRACTION_BITS : fraction;
  const int exponent = (biased ? biased : 1) - EXPONENT_BIAS - FRACTION_BITS;
  const char *sign = vx_sign(spec, negative);
  if (spec->letter == 'a')
    put_hexadecimal(text, spec, mantissa, exponent, sign);
  else
    put_decimal(text, spec, mantissa, exponent, sign);
}
