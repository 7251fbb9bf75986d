/* Conversions with a rounding of their own, to and from half. */
#include "half/vectors.h"

/* An integer that a float cannot hold is beyond the greatest half. */
#define TO_FLOAT(TYPE)                                                         \
  static float _CL_OVERLOADABLE to_float(TYPE x) { return (float)x; }
TO_FLOAT(char)
TO_FLOAT(uchar)
TO_FLOAT(short)
TO_FLOAT(ushort)
TO_FLOAT(int)
TO_FLOAT(uint)
TO_FLOAT(long)
TO_FLOAT(ulong)
TO_FLOAT(half)
TO_FLOAT(float)
#ifdef cl_khr_fp64
/* To the odd neighbour if it is between two, so that rounding again rounds as
   if for the first time. */
static float _CL_OVERLOADABLE to_float(double x) {
  const float below = convert_float_rtz(x);
  return as_float(as_uint(below) | (isfinite(x) && (double)below != x));
}
#endif

#define TO_HALF(TYPE, MODE)                                                    \
  half _CL_OVERLOADABLE convert_half##MODE(TYPE x) {                           \
  private                                                                      \
    half found;                                                                \
    vstore_half##MODE(to_float(x), 0, &found);                                 \
    return found;                                                              \
  }                                                                            \
  half2 _CL_OVERLOADABLE convert_half2##MODE(TYPE##2 x) {                      \
    return (half2)(convert_half##MODE(x.x), convert_half##MODE(x.y));          \
  }                                                                            \
  half3 _CL_OVERLOADABLE convert_half3##MODE(TYPE##3 x) {                      \
    return (half3)(convert_half2##MODE(x.xy), convert_half##MODE(x.z));        \
  }                                                                            \
  half4 _CL_OVERLOADABLE convert_half4##MODE(TYPE##4 x) {                      \
    return (half4)(convert_half2##MODE(x.lo), convert_half2##MODE(x.hi));      \
  }                                                                            \
  half8 _CL_OVERLOADABLE convert_half8##MODE(TYPE##8 x) {                      \
    return (half8)(convert_half4##MODE(x.lo), convert_half4##MODE(x.hi));      \
  }                                                                            \
  half16 _CL_OVERLOADABLE convert_half16##MODE(TYPE##16 x) {                   \
    return (half16)(convert_half8##MODE(x.lo), convert_half8##MODE(x.hi));     \
  }
#define TO_HALF_ROUNDED(TYPE)                                                  \
  TO_HALF(TYPE, _rte)                                                          \
  TO_HALF(TYPE, _rtz)                                                          \
  TO_HALF(TYPE, _rtp)                                                          \
  TO_HALF(TYPE, _rtn)
TO_HALF_ROUNDED(char)
TO_HALF_ROUNDED(uchar)
TO_HALF_ROUNDED(short)
TO_HALF_ROUNDED(ushort)
TO_HALF_ROUNDED(int)
TO_HALF_ROUNDED(uint)
TO_HALF_ROUNDED(long)
TO_HALF_ROUNDED(ulong)
TO_HALF_ROUNDED(half)
TO_HALF_ROUNDED(float)
__IF_FP64(TO_HALF_ROUNDED(double))

/* Each half is a float, too. The functions are inlined, as PoCL's are. If one
   returned a vector of bytes or shorts in a register, an element that TYPE
   cannot hold (poison, to LLVM) would spoil the elements beside it. */
#define FROM_HALF(N, TYPE, MODE)                                               \
  _CL_ALWAYSINLINE TYPE##N _CL_OVERLOADABLE convert_##TYPE##N##MODE(           \
      half##N x) {                                                             \
    return convert_##TYPE##N##MODE(cast_float(x));                             \
  }
#define FROM_HALF_ROUNDED(TYPE)                                                \
  FOR_SIZES(FROM_HALF, TYPE, _sat)                                             \
  FOR_SIZES(FROM_HALF, TYPE, _rte)                                             \
  FOR_SIZES(FROM_HALF, TYPE, _rtz)                                             \
  FOR_SIZES(FROM_HALF, TYPE, _rtp)                                             \
  FOR_SIZES(FROM_HALF, TYPE, _rtn)                                             \
  FOR_SIZES(FROM_HALF, TYPE, _sat_rte)                                         \
  FOR_SIZES(FROM_HALF, TYPE, _sat_rtz)                                         \
  FOR_SIZES(FROM_HALF, TYPE, _sat_rtp)                                         \
  FOR_SIZES(FROM_HALF, TYPE, _sat_rtn)
FROM_HALF_ROUNDED(char)
FROM_HALF_ROUNDED(uchar)
FROM_HALF_ROUNDED(short)
FROM_HALF_ROUNDED(ushort)
FROM_HALF_ROUNDED(int)
FROM_HALF_ROUNDED(uint)
FROM_HALF_ROUNDED(long)
FROM_HALF_ROUNDED(ulong)
