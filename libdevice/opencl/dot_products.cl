/* Dot products of four bytes each: cl_khr_integer_dot_product. */

/* DOT(type of the first, of the second, of the result, their letters) */
#define DOT(A, B, RESULT, LETTERS)                                             \
  RESULT _CL_OVERLOADABLE dot(A##4 a, B##4 b) {                                \
    return (RESULT)a.x * b.x + (RESULT)a.y * b.y + (RESULT)a.z * b.z +         \
           (RESULT)a.w * b.w;                                                  \
  }                                                                            \
  RESULT _CL_OVERLOADABLE dot_acc_sat(A##4 a, B##4 b, RESULT sum) {            \
    return add_sat(dot(a, b), sum);                                            \
  }                                                                            \
  RESULT _CL_OVERLOADABLE dot_4x8packed_##LETTERS##_##RESULT(uint a, uint b) { \
    return dot(as_##A##4(a), as_##B##4(b));                                    \
  }                                                                            \
  RESULT _CL_OVERLOADABLE dot_acc_sat_4x8packed_##LETTERS##_##RESULT(          \
      uint a, uint b, RESULT sum) {                                            \
    return dot_acc_sat(as_##A##4(a), as_##B##4(b), sum);                       \
  }
DOT(uchar, uchar, uint, uu)
DOT(char, char, int, ss)
DOT(uchar, char, int, us)
DOT(char, uchar, int, su)
