/* printf of OpenCL C. libdevice/print/ writes the text; PoCL only needs a
   function of this name among the built-in ones. */

#include <stdarg.h>

int vx_vprintf_opencl(const char *format, va_list arguments);

int printf(const char *restrict format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int status = vx_vprintf_opencl(format, arguments);
  va_end(arguments);
  return status;
}
