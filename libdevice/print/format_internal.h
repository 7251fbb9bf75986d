/* What the parts of the formatter share. */
#ifndef VX_FORMAT_INTERNAL_H
#define VX_FORMAT_INTERNAL_H

#include "format.h"

/* One conversion: %[flags][width][.precision][vector][length]letter. */
struct vx_spec {
  int left, plus, space, alternate, zero; /* flags - + ' ' # 0 */
  int width;
  int precision; /* -1 where not given */
  int vector;    /* elements, 0 for a scalar */
  int length;    /* bytes of a number: 1, 2, 4, 8, 16; 0 where not given */
  char letter;   /* lower case */
  int upper;
};

void vx_put(struct vx_text *text, char c);
void vx_put_repeated(struct vx_text *text, char c, int times);
void vx_put_bytes(struct vx_text *text, const char *bytes, int size);

/* A number's parts, padded to the width: prefix (sign, 0x), zeros, digits. */
void vx_put_padded(struct vx_text *text, const struct vx_spec *spec,
                   const char *prefix, int zeros, const char *digits, int size);

/* The sign that goes before a number: "-", "+", " " or "". */
const char *vx_sign(const struct vx_spec *spec, int negative);

void vx_format_integer(struct vx_text *text, const struct vx_spec *spec,
                       uint64_t magnitude, int negative);

/* bits: an IEEE double; letters f e g a. */
void vx_format_double(struct vx_text *text, const struct vx_spec *spec,
                      uint64_t bits);

/* The double nearest to a number of 128 bits (ties to even), by bits: no soft
   float needed. */
uint64_t vx_double_of_quad(uint64_t low, uint64_t high);

#endif
