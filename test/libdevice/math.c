// The C names of float functions: the device prints the bits of its results,
// the host's build of this file reads them and compares with doubles.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 -fno-builtin %s -o %t.elf && vorion-sim %t.elf > %t.device
// RUN: clang-19 -O1 %s -lm -o %t.host.exe && %t.host.exe %t.device | FileCheck %s
// CHECK: 3840 results, worst error {{[0-2]\.[0-9]+}} ulp
#include <stdint.h>

enum { ITEMS = 128, FUNCTIONS = 30 };

static float float_of(uint32_t bits) { return __builtin_bit_cast(float, bits); }

/* Arguments between 2^-20 and 2^5 in magnitude, for lane i and function f. */
static float argument(uint32_t i, uint32_t f, uint32_t which) {
  const uint32_t hash = (i * 40503u + f * 2654435761u + which * 97u) ^ i << 13;
  const uint32_t mixed = hash * 2246822519u ^ hash >> 15;
  return float_of((mixed & 0x807fffff) | (107 + mixed / 256 % 25) << 23);
}
static float unit(float x) { return x - __builtin_truncf(x); }

#ifdef __riscv_xvortex
#include <vorion.h>
#include <vorion_print.h>
#define X(name, argument) float name##f(float x);
#define Y(name, argument) float name##f(float x, float y);
#else
#include <math.h>
#include <stdio.h>
static double exp10_exact(double x) { return pow(10, x); }
#define exp10 exp10_exact
#define X(name, argument)
#define Y(name, argument)
#endif

// clang-format off: a list, which the formatter takes for an expression
#define LIST(X, Y)                                                   \
  X(sin, x) X(cos, x) X(tan, x)                                      \
  X(asin, unit(x)) X(acos, unit(x)) X(atan, x) Y(atan2, x)           \
  X(sinh, x) X(cosh, x) X(tanh, x)                                   \
  X(exp, x) X(exp2, x) X(exp10, x) X(expm1, x)                       \
  X(log, positive) X(log2, positive) X(log10, positive)              \
  X(log1p, positive) Y(pow, positive) X(cbrt, x) Y(hypot, x)         \
  Y(fmod, x) X(floor, x) X(ceil, x) X(trunc, x) X(round, x)          \
  X(rint, x) X(sqrt, positive) Y(fmin, x) Y(fmax, x)
// clang-format on

LIST(X, Y)
#undef X
#undef Y

#ifdef __riscv_xvortex
int main(void) {
  const uint32_t i = vx_core_id() * vx_num_threads() + vx_thread_id();
  uint32_t f = 0;
#define TRY(call)                                                              \
  {                                                                            \
    const float x = argument(i, f, 0), y = argument(i, f, 1);                  \
    const float positive = __builtin_fabsf(x);                                 \
    (void)positive;                                                            \
    (void)y;                                                                   \
    printf("%u %u %x\n", i, f, __builtin_bit_cast(uint32_t, call));            \
    ++f;                                                                       \
  }
#define X(name, argument) TRY(name##f(argument))
#define Y(name, argument) TRY(name##f(argument, y))
  LIST(X, Y)
  return 0;
}
#else
int main(int argc, char **argv) {
  FILE *file = argc == 2 ? fopen(argv[1], "r") : 0;
  if (!file)
    return 2;
  unsigned count = 0, i, f, bits;
  double worst = 0;
  while (fscanf(file, "%u %u %x", &i, &f, &bits) == 3) {
    const float x = argument(i, f, 0), y = argument(i, f, 1);
    const float positive = fabsf(x);
    double exact = 0;
    const char *name = "";
    unsigned at = 0;
#define X(function, argument)                                                  \
  if (at++ == f)                                                               \
    exact = function(argument), name = #function;
#define Y(function, argument)                                                  \
  if (at++ == f)                                                               \
    exact = function(argument, y), name = #function;
    LIST(X, Y)
    const double got = float_of(bits);
    const double unit_in_last_place =
        ldexp(1, ilogb(fmax(fabs(exact), 0x1p-126)) - 23);
    const double error = exact > 0x1p128 && isinf(got)
                             ? 0
                             : fabs(got - exact) / unit_in_last_place;
    if (!(error < 1.5))
      printf("%s(%g, %g) = %g, error %g\n", name, x, y, got, error);
    if (!(error < worst))
      worst = error;
    ++count;
  }
  printf("%u results, worst error %.3f ulp\n", count, worst);
  return 0;
}
#endif
