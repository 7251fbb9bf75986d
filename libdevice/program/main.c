/* The main of an image that has kernels only, for who starts it without a
   launch block. */

#include <vorion.h>
#include <vorion_print.h>

int main(void) {
  if (vx_core_id() == 0 && vx_thread_id() == 0)
    puts("this program has no main: start one of its kernels");
  return 1;
}
