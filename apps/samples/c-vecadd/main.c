/* Vector addition in C, without OpenCL: every lane of every core runs main.
 *
 *   vorion-clang main.c -o vecadd.elf && vorion-sim vecadd.elf
 */
#include <vorion.h>
#include <vorion_print.h>

enum { COUNT = 10000 };
static float a[COUNT], b[COUNT], sum[COUNT];

int main(void) {
  const uint first = vx_core_id() * vx_num_threads() + vx_thread_id();
  const uint step = vx_num_cores() * vx_num_threads();

  for (uint i = first; i < COUNT; i += step) {
    a[i] = (float)i;
    b[i] = 2.0f * (float)i;
  }
  for (uint i = first; i < COUNT; i += step)
    sum[i] = a[i] + b[i];

  /* Each lane looks at what it wrote: nothing is read across lanes. */
  uint wrong = 0;
  for (uint i = first; i < COUNT; i += step)
    wrong += sum[i] != 3.0f * (float)i;
  if (wrong)
    printf("lane %u of core %u: %u wrong sums\n", vx_thread_id(), vx_core_id(),
           wrong);
  else if (first == 0)
    printf("%d sums on %u cores of %u lanes\n", COUNT, vx_num_cores(),
           vx_num_threads());
  return wrong != 0;
}
