// What programs of one hart do and kernels seldom: static data of every width,
// arrays on the stack, calls by pointer, recursion.
#include <stdint.h>
#include <vorion_print.h>

enum { COUNT = 500 };

static int8_t bytes[COUNT];
static uint16_t halves[COUNT];
static uint32_t words[COUNT] = {1, 2, 3};
static const float table[4] = {0.5f, -1.25f, 3.0f, 1e-3f};
static float floats[COUNT];

static int ascending(uint32_t a, uint32_t b) { return a < b; }
static int by_low_byte(uint32_t a, uint32_t b) {
  return (uint8_t)a < (uint8_t)b;
}

__attribute__((noinline)) static void sort(uint32_t *from, uint32_t count,
                                           int (*before)(uint32_t, uint32_t)) {
  for (uint32_t n = 1; n < count; ++n)
    for (uint32_t m = n; m > 0 && before(from[m], from[m - 1]); --m) {
      const uint32_t word = from[m];
      from[m] = from[m - 1];
      from[m - 1] = word;
    }
}

__attribute__((noinline)) static uint32_t ackermann(uint32_t m, uint32_t n) {
  if (m == 0)
    return n + 1;
  return ackermann(m - 1, n == 0 ? 1 : ackermann(m, n - 1));
}

__attribute__((noinline)) static uint32_t mix(uint32_t seed) {
  uint32_t stack[64];
  uint8_t small[64];
  for (int n = 0; n < 64; ++n) {
    stack[n] = seed = seed * 1664525 + 1013904223;
    small[n] = (uint8_t)(seed >> 24);
  }
  sort(stack, 64, seed & 1 ? ascending : by_low_byte);
  for (int n = 0; n < 64; ++n)
    seed ^= stack[n] >> (small[n] & 31) | (uint32_t)small[63 - n] << 8;
  return seed;
}

int main(void) {
  uint32_t seed = 1;
  float sum = 0;
  for (int round = 0; round < 3; ++round)
    for (int n = 0; n < COUNT; ++n) {
      if (n % 50 == 0)
        seed = mix(seed);
      seed = seed * 1103515245 + 12345;
      bytes[n] = (int8_t)(seed >> 16);
      halves[n] += (uint16_t)(bytes[n] * 3);
      words[n] += (uint32_t)bytes[n] / (halves[n] % 7 + 1) +
                  (int32_t)seed % (bytes[n] | 1);
      floats[n] = (float)bytes[n] * table[n & 3] + (float)halves[n];
      sum = sum < 1e6f ? sum + floats[n] / (1.0f + (float)(words[n] & 255)) : 0;
      words[(seed >> 8) % COUNT] ^= (uint32_t)(int32_t)floats[n];
    }
  sort(words, COUNT, by_low_byte);
  uint32_t check = ackermann(2, 5);
  for (int n = 0; n < COUNT; ++n)
    check = check * 31 + words[n] + halves[n];
  printf("%08x %08x %d\n", (unsigned)check, (unsigned)seed, (int)(sum * 1000));
  return 0;
}
