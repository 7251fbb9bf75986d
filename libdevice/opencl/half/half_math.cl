/* The math functions of half that PoCL's libraries lack. */
#include "half/vectors.h"

#define OF_ONE(N, F)                                                           \
  half##N _CL_OVERLOADABLE F(half##N x) { return cast_half(F(cast_float(x))); }
#define OF_TWO(N, F)                                                           \
  half##N _CL_OVERLOADABLE F(half##N x, half##N y) {                           \
    return cast_half(F(cast_float(x), cast_float(y)));                         \
  }
#define WITH_INTEGER(N, F)                                                     \
  half##N _CL_OVERLOADABLE F(half##N x, int##N n) {                            \
    return cast_half(F(cast_float(x), n));                                     \
  }

FOR_SIZES(OF_ONE, acos)
FOR_SIZES(OF_ONE, acosh)
FOR_SIZES(OF_ONE, acospi)
FOR_SIZES(OF_ONE, asin)
FOR_SIZES(OF_ONE, asinh)
FOR_SIZES(OF_ONE, asinpi)
FOR_SIZES(OF_ONE, atan)
FOR_SIZES(OF_ONE, atanh)
FOR_SIZES(OF_ONE, atanpi)
FOR_SIZES(OF_ONE, cbrt)
FOR_SIZES(OF_ONE, cos)
FOR_SIZES(OF_ONE, cosh)
FOR_SIZES(OF_ONE, cospi)
FOR_SIZES(OF_ONE, degrees)
FOR_SIZES(OF_ONE, erf)
FOR_SIZES(OF_ONE, erfc)
FOR_SIZES(OF_ONE, exp)
FOR_SIZES(OF_ONE, exp10)
FOR_SIZES(OF_ONE, exp2)
FOR_SIZES(OF_ONE, expm1)
FOR_SIZES(OF_ONE, lgamma)
FOR_SIZES(OF_ONE, log)
FOR_SIZES(OF_ONE, log10)
FOR_SIZES(OF_ONE, log1p)
FOR_SIZES(OF_ONE, log2)
FOR_SIZES(OF_ONE, logb)
FOR_SIZES(OF_ONE, radians)
FOR_SIZES(OF_ONE, rsqrt)
FOR_SIZES(OF_ONE, sin)
FOR_SIZES(OF_ONE, sinh)
FOR_SIZES(OF_ONE, sinpi)
FOR_SIZES(OF_ONE, tan)
FOR_SIZES(OF_ONE, tanh)
FOR_SIZES(OF_ONE, tanpi)
FOR_SIZES(OF_ONE, tgamma)

FOR_SIZES(OF_TWO, atan2)
FOR_SIZES(OF_TWO, atan2pi)
FOR_SIZES(OF_TWO, fdim)
FOR_SIZES(OF_TWO, fmod)
FOR_SIZES(OF_TWO, hypot)
FOR_SIZES(OF_TWO, pow)
FOR_SIZES(OF_TWO, powr)
FOR_SIZES(OF_TWO, remainder)

FOR_SIZES(WITH_INTEGER, ldexp)
FOR_SIZES(WITH_INTEGER, pown)
FOR_SIZES(WITH_INTEGER, rootn)

#define EXPONENT(N, F)                                                         \
  int##N _CL_OVERLOADABLE F(half##N x) { return F(cast_float(x)); }
FOR_SIZES(EXPONENT, ilogb)

/* A second result goes through a pointer to any address space. */
#define FOR_SPACES(M, N, ...)                                                  \
  M(N, global, __VA_ARGS__)                                                    \
  M(N, local, __VA_ARGS__)                                                     \
  M(N, private, __VA_ARGS__)                                                   \
  M(N, generic, __VA_ARGS__)
#define AND_A_HALF(N, SPACE, F)                                                \
  half##N _CL_OVERLOADABLE F(half##N x, SPACE half##N *second) {               \
  private                                                                      \
    float##N found;                                                            \
    const float##N first = F(cast_float(x), &found);                           \
    *second = cast_half(found);                                                \
    return cast_half(first);                                                   \
  }
#define AND_AN_INTEGER(N, SPACE, F)                                            \
  half##N _CL_OVERLOADABLE F(half##N x, SPACE int##N *second) {                \
  private                                                                      \
    int##N found;                                                              \
    const float##N first = F(cast_float(x), (generic int##N *)&found);         \
    *second = found;                                                           \
    return cast_half(first);                                                   \
  }
#define QUOTIENT(N, SPACE, F)                                                  \
  half##N _CL_OVERLOADABLE F(half##N x, half##N y, SPACE int##N *quotient) {   \
  private                                                                      \
    int##N found;                                                              \
    const float##N rest =                                                      \
        F(cast_float(x), cast_float(y), (generic int##N *)&found);             \
    *quotient = found;                                                         \
    return cast_half(rest);                                                    \
  }
#define IN_SPACES(N, M, F) FOR_SPACES(M, N, F)
FOR_SIZES(IN_SPACES, AND_A_HALF, modf)
FOR_SIZES(IN_SPACES, AND_A_HALF, sincos)
FOR_SIZES(IN_SPACES, AND_AN_INTEGER, frexp)
FOR_SIZES(IN_SPACES, AND_AN_INTEGER, lgamma_r)
FOR_SIZES(IN_SPACES, QUOTIENT, remquo)

/* The next number as if halves were integers, with 0 once. */
half _CL_OVERLOADABLE nextafter(half x, half y) {
  if (isnan(x) || isnan(y))
    return x + y;
  if (x == y)
    return y;
  if (x == 0)
    return as_half((ushort)((as_ushort(y) & 0x8000) | 1));
  const short step = (x < y) == (x > 0) ? 1 : -1;
  return as_half((short)(as_short(x) + step));
}
#define NEXT(N)                                                                \
  half##N _CL_OVERLOADABLE nextafter(half##N x, half##N y) {                   \
    return (half##N)(nextafter(x.lo, y.lo), nextafter(x.hi, y.hi));            \
  }
NEXT(2)
NEXT(4)
NEXT(8)
NEXT(16)
half3 _CL_OVERLOADABLE nextafter(half3 x, half3 y) {
  return (half3)(nextafter(x.xy, y.xy), nextafter(x.z, y.z));
}
