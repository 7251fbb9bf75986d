/* The compiler turns printf of a plain text into these two, in OpenCL C too. */

#include "output.h"

#include <vorion_print.h>

static int print(const char *format, ...) {
  va_list list;
  va_start(list, format);
  const int count = vx_vprint(VX_DIALECT_C, format, list);
  va_end(list);
  return count;
}

int puts(const char *text) { return print("%s\n", text); }

int putchar(int c) { return print("%c", c) < 0 ? -1 : (unsigned char)c; }
