/* Greatest common divisors: lanes divide for as long as each of them needs. */
#include "kernel.h"

RESULT(uint, 256);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 256) {
    uint a = bits[base + lane], b = bytes[base + lane];
    while (b != 0) {
      const uint rest = a % b;
      a = b;
      b = rest;
    }
    result[base + lane] = a;
  }
  return 0;
}
