// A program for the device: every lane of every core.
#include <vorion.h>
#include <vorion_print.h>

int main(void) {
  if (vx_core_id() == 0 && vx_thread_id() == 5)
    printf("lane %u of %u\n", vx_thread_id(), vx_num_threads());
  return 0;
}
