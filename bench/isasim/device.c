/* main of a benchmark on the device, REPEATS times: lane 0 of core 0 prints the
   result. */
#include "bench.h"

int main(void) {
  uint32_t result = 0;
  for (uint32_t n = 0; n < REPEATS; ++n)
    result = work(vx_thread_id(), vx_num_threads());
  if (vx_core_id() == 0 && vx_thread_id() == 0) {
    volatile uint32_t *console = (volatile uint32_t *)VX_IO_CONSOLE;
    for (int shift = 28; shift >= 0; shift -= 4)
      *console = "0123456789abcdef"[result >> shift & 15];
    *console = '\n';
  }
  return 0;
}
