/* One pass of a radix sort, 4 bits of 512 words, by the first warp: each lane
   counts its words' digits in local memory, lanes scan the counts, and each
   moves its words. */
#include "kernel.h"

enum { DIGITS = 16, COUNT = 512, OWN = COUNT / LANES };
RESULT(uint, 512);

int main(void) {
  const uint lane = vx_thread_id();
  if (vx_warp_id() != 0)
    return 0;
  volatile uint *counts = LOCAL; /* by digit, then by lane */
#pragma nounroll
  for (uint d = 0; d < DIGITS; ++d)
    counts[d * LANES + lane] = 0;
  const uint *own = bits + lane * OWN;
#pragma nounroll
  for (uint n = 0; n < OWN; ++n)
    ++counts[own[n] % DIGITS * LANES + lane];
  /* A lane adds a digit's counts up; then the digits' sums. */
  uint sum = 0;
#pragma nounroll
  for (uint n = 0; n < LANES; ++n) {
    const uint before = sum;
    sum += counts[lane * LANES + n];
    counts[lane * LANES + n] = before;
  }
  volatile uint *sums = LOCAL + DIGITS * LANES;
  sums[lane] = sum;
  uint first = 0;
#pragma nounroll
  for (uint d = 0; d < DIGITS; ++d)
    if (d < lane)
      first += sums[d];
#pragma nounroll
  for (uint n = 0; n < LANES; ++n)
    counts[lane * LANES + n] = counts[lane * LANES + n] + first;
#pragma nounroll
  for (uint n = 0; n < OWN; ++n) {
    const uint word = own[n], at = word % DIGITS * LANES + lane;
    const uint place = counts[at];
    counts[at] = place + 1;
    result[place] = word;
  }
  return 0;
}
