/* Mixes 16 words of a line into one: multiplications, shifts, and branches that
   some lanes take. */
#include "kernel.h"

RESULT(uint, 1024);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, 64) {
    const uint *words = bits + 16 * (base + lane);
    uint hash = 2166136261U, odd = 0;
#pragma nounroll
    for (uint n = 0; n < 16; ++n) {
      hash = (hash ^ words[n]) * 16777619U;
      hash ^= hash >> 13;
      if (hash & 1) {
        hash = (hash >> 5 | hash << 27) * 2246822519U;
        odd += hash >> 20;
        hash ^= odd;
      }
    }
    result[16 * (base + lane)] = hash;
    result[16 * (base + lane) + 1] = odd;
  }
  return 0;
}
