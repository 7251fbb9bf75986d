/* Fields of bits, and bits in reverse: cl_khr_extended_bit_ops. A field that is
   not all within the number is undefined. */
#include "sizes.h"

/* FIELDS(number of elements, signed type, unsigned type, bits) */
#define FIELDS(N, TYPE, UTYPE, BITS)                                           \
  static inline UTYPE##N _CL_OVERLOADABLE insert_field(                        \
      UTYPE##N base, UTYPE##N field, uint offset, uint count) {                \
    const UTYPE ones = count ? (UTYPE) ~(UTYPE)0 >> (BITS - count) : 0;        \
    const UTYPE##N mask = (UTYPE)(ones << offset);                             \
    return (base & ~mask) | ((field << (UTYPE##N)(UTYPE)offset) & mask);       \
  }                                                                            \
  /* The field at the top of the number. */                                    \
  static inline UTYPE##N _CL_OVERLOADABLE raise_field(                         \
      UTYPE##N value, uint offset, uint count) {                               \
    return value << (UTYPE##N)(UTYPE)(BITS - offset - count);                  \
  }                                                                            \
  TYPE##N _CL_OVERLOADABLE bitfield_insert(TYPE##N base, TYPE##N field,        \
                                           uint offset, uint count) {          \
    return as_##TYPE##N(insert_field(as_##UTYPE##N(base),                      \
                                     as_##UTYPE##N(field), offset, count));    \
  }                                                                            \
  UTYPE##N _CL_OVERLOADABLE bitfield_insert(UTYPE##N base, UTYPE##N field,     \
                                            uint offset, uint count) {         \
    return insert_field(base, field, offset, count);                           \
  }                                                                            \
  TYPE##N _CL_OVERLOADABLE bitfield_extract_signed(UTYPE##N value,             \
                                                   uint offset, uint count) {  \
    if (count == 0)                                                            \
      return (TYPE##N)0;                                                       \
    return as_##TYPE##N(raise_field(value, offset, count)) >>                  \
           (TYPE##N)(TYPE)(BITS - count);                                      \
  }                                                                            \
  TYPE##N _CL_OVERLOADABLE bitfield_extract_signed(TYPE##N value, uint offset, \
                                                   uint count) {               \
    return bitfield_extract_signed(as_##UTYPE##N(value), offset, count);       \
  }                                                                            \
  UTYPE##N _CL_OVERLOADABLE bitfield_extract_unsigned(                         \
      UTYPE##N value, uint offset, uint count) {                               \
    if (count == 0)                                                            \
      return (UTYPE##N)0;                                                      \
    return raise_field(value, offset, count) >>                                \
           (UTYPE##N)(UTYPE)(BITS - count);                                    \
  }                                                                            \
  UTYPE##N _CL_OVERLOADABLE bitfield_extract_unsigned(                         \
      TYPE##N value, uint offset, uint count) {                                \
    return bitfield_extract_unsigned(as_##UTYPE##N(value), offset, count);     \
  }
FOR_SIZES(FIELDS, char, uchar, 8)
FOR_SIZES(FIELDS, short, ushort, 16)
FOR_SIZES(FIELDS, int, uint, 32)
FOR_SIZES(FIELDS, long, ulong, 64)

#define REVERSE(N, TYPE)                                                       \
  TYPE##N _CL_OVERLOADABLE bit_reverse(TYPE##N value) {                        \
    return __builtin_elementwise_bitreverse(value);                            \
  }
FOR_SIZES(REVERSE, int)
FOR_SIZES(REVERSE, uint)
FOR_SIZES(REVERSE, long)
FOR_SIZES(REVERSE, ulong)

/* A single number of fewer bits would be an int first. */
#define REVERSE_SHORT(TYPE, BITS)                                              \
  TYPE _CL_OVERLOADABLE bit_reverse(TYPE value) {                              \
    return (TYPE)(bit_reverse((uint)value) >> (32 - BITS));                    \
  }                                                                            \
  FOR_VECTORS(REVERSE, TYPE)
REVERSE_SHORT(char, 8)
REVERSE_SHORT(uchar, 8)
REVERSE_SHORT(short, 16)
REVERSE_SHORT(ushort, 16)
