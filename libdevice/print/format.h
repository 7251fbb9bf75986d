/* Formatted text, as C's and OpenCL C's printf define it. */
#ifndef VX_FORMAT_H
#define VX_FORMAT_H

#include <stdarg.h>
#include <stdint.h>

/* Bytes go to the console, or to [at, end) while there is room; count says how
   many there were. */
struct vx_text {
  char *at, *end;
  uint32_t count;
  int console;
};

/* Writes to the machine's console. A call through a pointer would have to be
   proved uniform, so this is a function of that name. */
void vx_put_console(char c);

enum vx_dialect {
  /* C17 7.21.6.1: floating arguments are doubles, `l` means long. */
  VX_DIALECT_C,
  /* OpenCL C 6.15.14: `l` means 64 bits, `%v4hlf` prints a vector of floats,
     `%v4lf` one of doubles. */
  VX_DIALECT_OPENCL
};

/* Appends the text. Returns 0, or -1 at the first malformed conversion, which
   ends the text (an unknown letter, a vector where none is allowed, %n). */
int vx_format(struct vx_text *text, enum vx_dialect dialect, const char *format,
              va_list arguments);

#endif
