// sinf, cosf and tanf of arguments of every size above 2^15, against doubles
// of the host.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 -fno-builtin %s -o %t.elf && vorion-sim %t.elf > %t.device
// RUN: clang-19 -O1 %s -lm -o %t.host.exe && %t.host.exe %t.device | FileCheck %s
// CHECK-NOT: error
// CHECK: 768 results, {{[1-9][0-9]*}} of 0 or less
#include <stdint.h>

/* 128 work-items, two arguments each: the first ones by hand, among them the
   float nearest to a multiple of pi/2, then all exponents. */
static float argument(uint32_t i) {
  const float chosen[] = {1e5f,
                          1e6f,
                          1e10f,
                          3e38f,
                          39000.0f,
                          32768.0f,
                          -1e5f,
                          -1e6f,
                          -1e10f,
                          -3e38f,
                          -39000.5f,
                          32767.998f,
                          0x1.fffffep127f,
                          16367173.0f * 0x1p72f};
  if (i < sizeof(chosen) / sizeof(chosen[0]))
    return chosen[i];
  const uint32_t hash = i * 2654435761u;
  return __builtin_bit_cast(float, (hash & 0x807fffff) | (127 + 15 + i % 113)
                                                             << 23);
}

#ifdef __riscv_xvortex
#include <vorion.h>
#include <vorion_print.h>
float sinf(float), cosf(float), tanf(float);

int main(void) {
  const uint32_t i = vx_core_id() * vx_num_threads() + vx_thread_id();
  for (uint32_t n = i; n < 256; n += 128) {
    const float x = argument(n);
    printf("%u %x %x %x\n", n, __builtin_bit_cast(uint32_t, sinf(x)),
           __builtin_bit_cast(uint32_t, cosf(x)),
           __builtin_bit_cast(uint32_t, tanf(x)));
  }
  return 0;
}
#else
#include <math.h>
#include <stdio.h>

int main(int argc, char **argv) {
  FILE *file = argc == 2 ? fopen(argv[1], "r") : 0;
  if (!file)
    return 2;
  unsigned count = 0, negative = 0, n, bits[3];
  while (fscanf(file, "%u %x %x %x", &n, &bits[0], &bits[1], &bits[2]) == 4) {
    const double x = argument(n), exact[] = {sin(x), cos(x), tan(x)};
    for (int f = 0; f != 3; ++f, ++count) {
      const double got = __builtin_bit_cast(float, bits[f]);
      const double error =
          fabs(got - exact[f]) / ldexp(1, ilogb(exact[f]) - 23);
      negative += got <= 0;
      /* Below 2^15 SLEEF answers, within 1 ulp. */
      if (!(error < (fabs(x) < 32768 ? 1.0 : 0.51)))
        printf("%c(%a) = %a, error %g\n", "sct"[f], x, got, error);
    }
  }
  printf("%u results, %u of 0 or less\n", count, negative);
  return 0;
}
#endif
