/* An integer mix: shifts, logic, additions, rotations, multiplications. */
#include "bench.h"

enum { ROUNDS = 1200000 };

uint32_t work(uint32_t lane, uint32_t lanes) {
  (void)lanes;
  uint32_t a = 0x9e3779b9u + lane, b = 0x85ebca6bu ^ lane, c = 1, d = lane;
  for (int n = 0; n < ROUNDS; ++n) {
    a ^= a << 13;
    a ^= a >> 17;
    a ^= a << 5;
    b = b * 1664525u + 1013904223u;
    c += a ^ (b >> 3);
    d = (d << 7 | d >> 25) + c;
    c ^= (d & a) | (b & ~a);
    d -= c > d ? 77 : c;
  }
  return a ^ b ^ c ^ d;
}
