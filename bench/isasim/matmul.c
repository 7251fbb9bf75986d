/* C = A B for 128x128 floats: a lane computes four rows of its columns at a
   time, so that an element of B is used four times. */
#include "bench.h"

enum { N = 128, ROWS = 4, PASSES = 8 };

uint32_t work(uint32_t lane, uint32_t lanes) {
  float *a = bench_memory(), *b = a + N * N, *c = b + N * N;
  for (uint32_t n = lane; n < N * N; n += lanes) {
    a[n] = (float)(int)(bench_hash(n) % 33) - 16;
    b[n] = (float)(int)(bench_hash(~n) % 33) - 16;
  }
  bench_step();
  for (int pass = 0; pass < PASSES; ++pass) {
    for (uint32_t row = 0; row < N; row += ROWS)
      for (uint32_t column = lane; column < N; column += lanes) {
        float s0 = 0, s1 = 0, s2 = 0, s3 = 0;
        const float *left = a + row * N, *right = b + column;
#pragma clang loop unroll_count(4)
        for (uint32_t k = 0; k < N; ++k) {
          const float x = right[k * N];
          s0 = __builtin_fmaf(left[k], x, s0);
          s1 = __builtin_fmaf(left[N + k], x, s1);
          s2 = __builtin_fmaf(left[2 * N + k], x, s2);
          s3 = __builtin_fmaf(left[3 * N + k], x, s3);
        }
        float *to = c + row * N + column;
        to[0] = s0;
        to[N] = s1;
        to[2 * N] = s2;
        to[3 * N] = s3;
      }
    bench_step();
  }
  uint32_t sum = 0;
  if (lane == 0)
    for (uint32_t n = 0; n < N * N; ++n)
      sum = sum * 31 + (uint32_t)(int)c[n];
  return sum;
}
