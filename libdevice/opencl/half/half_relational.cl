/* Questions about halves, choices between them, and their geometry. */
#include "half/vectors.h"

/* True is 1 of a single value, and -1 in a vector. */
#define QUESTION(F, ANSWER)                                                    \
  int _CL_OVERLOADABLE F(half x) {                                             \
    const ushort exponent = as_ushort(x) & 0x7C00;                             \
    const ushort fraction = as_ushort(x) & 0x03FF;                             \
    return ANSWER;                                                             \
  }                                                                            \
  FOR_VECTORS(QUESTIONS, F, ANSWER)
#define QUESTIONS(N, F, ANSWER)                                                \
  short##N _CL_OVERLOADABLE F(half##N x) {                                     \
    const ushort##N exponent = as_ushort##N(x) & (ushort)0x7C00;               \
    const ushort##N fraction = as_ushort##N(x) & (ushort)0x03FF;               \
    return ANSWER;                                                             \
  }
#define BITS(X) ((ushort)(X))
QUESTION(isfinite, exponent != BITS(0x7C00))
QUESTION(isinf, exponent == BITS(0x7C00) && fraction == BITS(0))
QUESTION(isnan, exponent == BITS(0x7C00) && fraction != BITS(0))
QUESTION(isnormal, exponent != BITS(0) && exponent != BITS(0x7C00))

half _CL_OVERLOADABLE select(half a, half b, short c) { return c ? b : a; }
half _CL_OVERLOADABLE select(half a, half b, ushort c) { return c ? b : a; }
#define SELECT(N, C)                                                           \
  half##N _CL_OVERLOADABLE select(half##N a, half##N b, C##N c) {              \
    return as_half##N(select(as_##C##N(a), as_##C##N(b), c));                  \
  }
FOR_VECTORS(SELECT, short)
FOR_VECTORS(SELECT, ushort)

#define GEOMETRY(N)                                                            \
  half _CL_OVERLOADABLE dot(half##N x, half##N y) {                            \
    return cast_half(dot(cast_float(x), cast_float(y)));                       \
  }                                                                            \
  half _CL_OVERLOADABLE length(half##N x) {                                    \
    return cast_half(length(cast_float(x)));                                   \
  }                                                                            \
  half##N _CL_OVERLOADABLE normalize(half##N x) {                              \
    return cast_half(normalize(cast_float(x)));                                \
  }
GEOMETRY()
GEOMETRY(2)
GEOMETRY(3)
GEOMETRY(4)

#define CROSS(N)                                                               \
  half##N _CL_OVERLOADABLE cross(half##N x, half##N y) {                       \
    return cast_half(cross(cast_float(x), cast_float(y)));                     \
  }
CROSS(3)
CROSS(4)
