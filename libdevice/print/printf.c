/* C's printf: a file of its own, since OpenCL's kernel library brings another
   one of that name. */

#include "output.h"

#include <vorion_print.h>

int printf(const char *format, ...) {
  va_list list;
  va_start(list, format);
  const int count = vx_vprint(VX_DIALECT_C, format, list);
  va_end(list);
  return count;
}

int snprintf(char *bytes, size_t size, const char *format, ...) {
  struct vx_text text = {.at = bytes, .end = bytes + (size ? size - 1 : 0)};
  va_list list;
  va_start(list, format);
  const int result = vx_format(&text, VX_DIALECT_C, format, list);
  va_end(list);
  if (size)
    *text.at = 0;
  return result ? -1 : (int)text.count;
}
