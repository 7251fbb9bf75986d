/* The main of an image that has kernels only, for who starts it without a
   launch block. It leaves the printer of formatted texts, 12 KiB, out of the
   image. */

#include "../print/format.h"

#include <vorion.h>

int main(void) {
  const char *text = "this program has no main: start one of its kernels\n";
  if (vx_core_id() == 0 && vx_thread_id() == 0)
    while (*text)
      vx_put_console(*text++);
  return 1;
}
