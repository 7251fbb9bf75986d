#include "format_internal.h"

void vx_format_integer(struct vx_text *text, const struct vx_spec *spec,
                       uint64_t magnitude, int negative) {
  const int is_signed = spec->letter == 'd' || spec->letter == 'i';
  const unsigned base = spec->letter == 'o' ? 8 : spec->letter == 'x' ? 16 : 10;
  const char *letters = spec->upper ? "0123456789ABCDEF" : "0123456789abcdef";
  char digits[22]; /* 2^64 in octal */
  int size = 0;
  for (uint64_t rest = magnitude; rest; rest /= base)
    digits[sizeof(digits) - (unsigned)++size] = letters[rest % base];

  int wanted = spec->precision < 0 ? 1 : spec->precision;
  if (spec->letter == 'o' && spec->alternate && wanted <= size)
    wanted = size + 1; /* the first digit is a 0 */
  const char *prefix = is_signed ? vx_sign(spec, negative) : "";
  if (spec->letter == 'x' && spec->alternate && magnitude)
    prefix = spec->upper ? "0X" : "0x";
  int zeros = wanted > size ? wanted - size : 0;
  if (spec->zero && !spec->left && spec->precision < 0) {
    const int used = size + zeros + (prefix[0] ? (prefix[1] ? 2 : 1) : 0);
    if (spec->width > used)
      zeros += spec->width - used;
  }
  vx_put_padded(text, spec, prefix, zeros, digits + sizeof(digits) - size,
                size);
}
