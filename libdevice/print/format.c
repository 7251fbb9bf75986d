#include "format_internal.h"

#include <stddef.h>

void vx_put(struct vx_text *text, char c) {
  if (text->console)
    vx_put_console(c);
  else if (text->at < text->end)
    *text->at++ = c;
  ++text->count;
}

void vx_put_repeated(struct vx_text *text, char c, int times) {
  for (int i = 0; i < times; ++i)
    vx_put(text, c);
}

void vx_put_bytes(struct vx_text *text, const char *bytes, int size) {
  for (int i = 0; i < size; ++i)
    vx_put(text, bytes[i]);
}

void vx_put_padded(struct vx_text *text, const struct vx_spec *spec,
                   const char *prefix, int zeros, const char *digits,
                   int size) {
  int prefix_size = 0;
  while (prefix[prefix_size])
    ++prefix_size;
  const int padding = spec->width - prefix_size - zeros - size;
  if (!spec->left)
    vx_put_repeated(text, ' ', padding);
  vx_put_bytes(text, prefix, prefix_size);
  vx_put_repeated(text, '0', zeros);
  vx_put_bytes(text, digits, size);
  if (spec->left)
    vx_put_repeated(text, ' ', padding);
}

const char *vx_sign(const struct vx_spec *spec, int negative) {
  if (negative)
    return "-";
  return spec->plus ? "+" : spec->space ? " " : "";
}

/* The argument list behind a pointer, so that helpers advance the caller's. */
struct arguments {
  va_list list;
};

static int is_digit(char c) { return c >= '0' && c <= '9'; }

static int parse_number(const char **at) {
  int value = 0;
  for (; is_digit(**at); ++*at)
    if (value < 1000000) /* far beyond any text; keeps the sum in range */
      value = value * 10 + (**at - '0');
  return value;
}

static void parse_flags(struct vx_spec *spec, const char **at) {
  for (;; ++*at) {
    switch (**at) {
    case '-':
      spec->left = 1;
      break;
    case '+':
      spec->plus = 1;
      break;
    case ' ':
      spec->space = 1;
      break;
    case '#':
      spec->alternate = 1;
      break;
    case '0':
      spec->zero = 1;
      break;
    default:
      return;
    }
  }
}

static void parse_width(struct vx_spec *spec, const char **at,
                        struct arguments *arguments) {
  if (**at == '*') {
    ++*at;
    spec->width = va_arg(arguments->list, int);
    if (spec->width < 0) {
      spec->left = 1;
      spec->width = -spec->width;
    }
  } else {
    spec->width = parse_number(at);
  }
  spec->precision = -1;
  if (**at == '.') {
    ++*at;
    if (**at == '*') {
      ++*at;
      spec->precision = va_arg(arguments->list, int);
      if (spec->precision < 0)
        spec->precision = -1;
    } else {
      spec->precision = parse_number(at);
    }
  }
}

static void parse_length(struct vx_spec *spec, const char **at,
                         enum vx_dialect dialect) {
  const char *p = *at;
  int size = 0, chars = 0;
  if (p[0] == 'h' && p[1] == 'h')
    size = 1, chars = 2;
  else if (p[0] == 'h' && p[1] == 'l')
    size = 4, chars = 2;
  else if (p[0] == 'h')
    size = 2, chars = 1;
  else if (p[0] == 'l' && p[1] == 'l')
    size = 8, chars = 2;
  else if (p[0] == 'l')
    size = dialect == VX_DIALECT_OPENCL ? 8 : (int)sizeof(long), chars = 1;
  else if (p[0] == 'j')
    size = 8, chars = 1;
  else if (p[0] == 'L' && dialect == VX_DIALECT_C)
    size = 16, chars = 1;
  else if (p[0] == 'z' || p[0] == 't')
    size = (int)sizeof(size_t), chars = 1;
  spec->length = size;
  *at += chars;
}

/* Parses after '%'; 0 if malformed. */
static int parse_spec(struct vx_spec *spec, const char **at,
                      enum vx_dialect dialect, struct arguments *arguments) {
  *spec = (struct vx_spec){0};
  parse_flags(spec, at);
  parse_width(spec, at, arguments);
  if (**at == 'v' && dialect == VX_DIALECT_OPENCL) {
    ++*at;
    spec->vector = parse_number(at);
    const int n = spec->vector;
    if (n != 2 && n != 3 && n != 4 && n != 8 && n != 16)
      return 0;
  }
  parse_length(spec, at, dialect);
  char letter = **at;
  if (letter == 0)
    return 0;
  ++*at;
  if (letter == 'X' || letter == 'F' || letter == 'E' || letter == 'G' ||
      letter == 'A') {
    spec->upper = 1;
    letter = (char)(letter - 'A' + 'a');
  }
  spec->letter = letter;
  return 1;
}

/* Integer of `size` bytes at p, or a value as it was passed, sign-extended to
   64 bits if the conversion is signed. */
static void put_integer(struct vx_text *text, const struct vx_spec *spec,
                        uint64_t value, int size) {
  const int unused = 64 - 8 * size;
  const int is_signed = spec->letter == 'd' || spec->letter == 'i';
  if (is_signed) {
    const int64_t wide = (int64_t)(value << unused) >> unused;
    vx_format_integer(text, spec, wide < 0 ? -(uint64_t)wide : (uint64_t)wide,
                      wide < 0);
  } else {
    vx_format_integer(text, spec, value << unused >> unused, 0);
  }
}

/* The double with the value of a narrower number, by bits: no soft double
   needed. */
static uint64_t widen(uint64_t bits, int exponent_bits, int fraction_bits) {
  const int special = (1 << exponent_bits) - 1, bias = special >> 1;
  const uint64_t one = (uint64_t)1 << fraction_bits;
  const uint64_t sign = bits >> (exponent_bits + fraction_bits) << 63;
  uint64_t fraction = bits & (one - 1);
  int exponent = (int)(bits >> fraction_bits) & special;
  if (exponent == special)
    return sign | (uint64_t)0x7ff << 52 | fraction << (52 - fraction_bits);
  if (exponent == 0) {
    if (fraction == 0)
      return sign;
    for (exponent = 1; !(fraction & one); --exponent)
      fraction <<= 1;
    fraction &= one - 1;
  }
  return sign | (uint64_t)(exponent - bias + 1023) << 52 |
         fraction << (52 - fraction_bits);
}

/* The double with the value of a half, a float or a double. */
static uint64_t double_of(uint64_t bits, int size) {
  return size == 2 ? widen(bits, 5, 10) : size == 4 ? widen(bits, 8, 23) : bits;
}

uint64_t vx_double_of_quad(uint64_t low, uint64_t high) {
  const uint64_t sign = high >> 63 << 63, infinity = (uint64_t)0x7ff << 52;
  const int biased = (int)(high >> 48 & 0x7fff);
  const uint64_t fraction = high << 16 >> 1 | low >> 49, rest = low << 15;
  if (biased == 0x7fff)
    return sign | infinity | (uint64_t)((fraction | rest) != 0) << 51;
  /* The first of 64 bits is 1, and the last says what was cut off. */
  const uint64_t significand = (uint64_t)1 << 63 | fraction | (rest != 0);
  const int exponent = biased - 16383 + 1023;
  if (exponent >= 0x7ff)
    return sign | infinity;
  const int shift = exponent > 0 ? 11 : 12 - exponent;
  if (shift > 64)
    return sign;
  const uint64_t half = (uint64_t)1 << (shift - 1);
  const uint64_t below = significand & (half | (half - 1));
  uint64_t value = shift == 64 ? 0 : significand >> shift;
  value += below > half || (below == half && value & 1);
  /* The first bit of a normal number adds 1 to its exponent. */
  return sign | (value + ((uint64_t)(exponent > 0 ? exponent - 1 : 0) << 52));
}

/* A vector argument as the ABI passes it (RISC-V calling convention, "Integer
   Calling Convention"): up to four bytes in a word, eight in an aligned pair,
   more by reference. */
static const unsigned char *take_vector(struct arguments *arguments, int size,
                                        uint64_t *small) {
  if (size > 8)
    return va_arg(arguments->list, const unsigned char *);
  *small = size <= 4 ? va_arg(arguments->list, uint32_t)
                     : va_arg(arguments->list, uint64_t);
  return (const unsigned char *)small;
}

static int put_vector(struct vx_text *text, const struct vx_spec *spec,
                      struct arguments *arguments) {
  const int is_float = spec->letter == 'f' || spec->letter == 'e' ||
                       spec->letter == 'g' || spec->letter == 'a';
  const int size = spec->length ? spec->length : 4;
  if (is_float && size < 2)
    return -1;
  uint64_t small = 0;
  /* A vector of three has the size of one of four. */
  const int lanes = spec->vector == 3 ? 4 : spec->vector;
  const unsigned char *at = take_vector(arguments, size * lanes, &small);
  for (int i = 0; i < spec->vector; ++i, at += size) {
    uint64_t value = 0;
    for (int k = 0; k < size; ++k)
      value |= (uint64_t)at[k] << (8 * k);
    if (i)
      vx_put(text, ',');
    if (is_float)
      vx_format_double(text, spec, double_of(value, size));
    else
      put_integer(text, spec, value, size);
  }
  return 0;
}

static void put_scalar_integer(struct vx_text *text, const struct vx_spec *spec,
                               struct arguments *arguments) {
  const int size = spec->length ? spec->length : (int)sizeof(int);
  const uint64_t value = size == 8 ? va_arg(arguments->list, uint64_t)
                                   : va_arg(arguments->list, uint32_t);
  put_integer(text, spec, value, size);
}

static void put_scalar_float(struct vx_text *text, const struct vx_spec *spec,
                             struct arguments *arguments) {
#if __LDBL_MANT_DIG__ == 113
  if (spec->length == 16) {
    const long double wide = va_arg(arguments->list, long double);
    uint64_t parts[2];
    __builtin_memcpy(parts, &wide, sizeof(parts));
    vx_format_double(text, spec, vx_double_of_quad(parts[0], parts[1]));
    return;
  }
#endif
  const double value = va_arg(arguments->list, double);
  uint64_t bits;
  __builtin_memcpy(&bits, &value, sizeof(bits));
  vx_format_double(text, spec, bits);
}

static void put_string(struct vx_text *text, const struct vx_spec *spec,
                       const char *string) {
  if (!string)
    string = "(null)";
  int size = 0;
  while ((spec->precision < 0 || size < spec->precision) && string[size])
    ++size;
  vx_put_padded(text, spec, "", 0, string, size);
}

static int put_conversion(struct vx_text *text, const struct vx_spec *spec,
                          struct arguments *arguments) {
  struct vx_spec plain = *spec;
  switch (spec->letter) {
  case 'd':
  case 'i':
  case 'o':
  case 'u':
  case 'x':
    if (spec->length == 16)
      return -1;
    if (spec->vector)
      return put_vector(text, spec, arguments);
    put_scalar_integer(text, spec, arguments);
    return 0;
  case 'f':
  case 'e':
  case 'g':
  case 'a':
    if (spec->vector)
      return put_vector(text, spec, arguments);
    put_scalar_float(text, spec, arguments);
    return 0;
  default:
    break;
  }
  if (spec->vector)
    return -1;
  switch (spec->letter) {
  case 'c': {
    const char c = (char)va_arg(arguments->list, int);
    vx_put_padded(text, spec, "", 0, &c, 1);
    return 0;
  }
  case 's':
    put_string(text, spec, va_arg(arguments->list, const char *));
    return 0;
  case 'p':
    plain.letter = 'x';
    plain.alternate = 1;
    vx_format_integer(text, &plain,
                      (uintptr_t)va_arg(arguments->list, const void *), 0);
    return 0;
  case '%':
    vx_put(text, '%');
    return 0;
  default:
    return -1;
  }
}

int vx_format(struct vx_text *text, enum vx_dialect dialect, const char *format,
              va_list list) {
  struct arguments arguments;
  va_copy(arguments.list, list);
  int result = 0;
  while (*format && result == 0) {
    if (*format != '%') {
      vx_put(text, *format++);
      continue;
    }
    ++format;
    struct vx_spec spec;
    result = parse_spec(&spec, &format, dialect, &arguments)
                 ? put_conversion(text, &spec, &arguments)
                 : -1;
  }
  va_end(arguments.list);
  return result;
}
