/* What csmith's programs include, for programs of which each lane has its own
   global variables (csmith_source.py). Nothing here is csmith's own header: the
   functions that its programs call are defined by what their names say. */
#include "kernels.h"
#include <stdint.h>

/* A result that C leaves undefined is replaced by the first operand. */
#define SAFE_SIGNED(bits)                                                      \
  SAFE_OPERATION(int##bits##_t, add, s_s,                                      \
                 __builtin_add_overflow(a, b, &r) ? a : r)                     \
  SAFE_OPERATION(int##bits##_t, sub, s_s,                                      \
                 __builtin_sub_overflow(a, b, &r) ? a : r)                     \
  SAFE_OPERATION(int##bits##_t, mul, s_s,                                      \
                 __builtin_mul_overflow(a, b, &r) ? a : r)                     \
  SAFE_OPERATION(int##bits##_t, div, s_s, b == 0 || b == -1 ? a : a / b)       \
  SAFE_OPERATION(int##bits##_t, mod, s_s, b == 0 || b == -1 ? a : a % b)       \
  SAFE_SHIFT(int##bits##_t, int, s_s, bits)                                    \
  SAFE_SHIFT(int##bits##_t, unsigned, s_u, bits)                               \
  static inline UNUSED int##bits##_t safe_unary_minus_func_int##bits##_t_s(    \
      int##bits##_t a) {                                                       \
    int##bits##_t r;                                                           \
    return __builtin_sub_overflow(0, a, &r) ? a : r;                           \
  }
#define SAFE_UNSIGNED(bits)                                                    \
  SAFE_OPERATION(uint##bits##_t, add, u_u, a + b)                              \
  SAFE_OPERATION(uint##bits##_t, sub, u_u, a - b)                              \
  SAFE_OPERATION(uint##bits##_t, mul, u_u, (uint##bits##_t)((uint64_t)a * b))  \
  SAFE_OPERATION(uint##bits##_t, div, u_u, b == 0 ? a : a / b)                 \
  SAFE_OPERATION(uint##bits##_t, mod, u_u, b == 0 ? a : a % b)                 \
  SAFE_SHIFT(uint##bits##_t, int, u_s, bits)                                   \
  SAFE_SHIFT(uint##bits##_t, unsigned, u_u, bits)                              \
  static inline UNUSED uint##bits##_t safe_unary_minus_func_uint##bits##_t_u(  \
      uint##bits##_t a) {                                                      \
    return -a;                                                                 \
  }
#define SAFE_OPERATION(type, name, signs, result)                              \
  static inline UNUSED type safe_##name##_func_##type##_##signs(type a,        \
                                                                type b) {      \
    type r;                                                                    \
    (void)r;                                                                   \
    return result;                                                             \
  }
#define SAFE_SHIFT(type, by, signs, bits)                                      \
  static inline UNUSED type safe_lshift_func_##type##_##signs(type a, by b) {  \
    return (unsigned)b >= bits || a < 0 ? a : (type)((uint64_t)a << b);        \
  }                                                                            \
  static inline UNUSED type safe_rshift_func_##type##_##signs(type a, by b) {  \
    return (unsigned)b >= bits || a < 0 ? a : (type)(a >> b);                  \
  }
/* clang-format off: it takes these for the head of a function */
SAFE_SIGNED(8)
SAFE_SIGNED(16)
SAFE_SIGNED(32)
SAFE_SIGNED(64)
SAFE_UNSIGNED(8)
SAFE_UNSIGNED(16)
SAFE_UNSIGNED(32)
SAFE_UNSIGNED(64)
/* clang-format on */

/* The sum of a lane is a variable of its main function. */
static inline uint mix(uint sum, ulong value) {
  sum = (sum ^ (uint)value) * 0x9e3779b1u;
  sum = (sum ^ sum >> 15 ^ (uint)(value >> 32)) * 0x85ebca77u;
  return sum ^ sum >> 13;
}
#define platform_main_begin()                                                  \
  uint crc32_context = 1;                                                      \
  perturb()
#define crc32_gentab() (void)0
#define transparent_crc(value, name, flag)                                     \
  (crc32_context = mix(crc32_context, (ulong)(value)))
#define platform_main_end(sum, flag) return (int)(sum)
#define printf(...) (void)0
