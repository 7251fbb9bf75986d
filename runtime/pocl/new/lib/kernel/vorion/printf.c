/* printf of OpenCL C. libdevice writes the text; PoCL only needs a function of
   this name in the kernel library. */

#include <stdarg.h>

int vx_vprintf_opencl (const char *format, va_list arguments);

int
printf (const char *restrict format, ...)
{
  va_list arguments;
  va_start (arguments, format);
  const int status = vx_vprintf_opencl (format, arguments);
  va_end (arguments);
  return status;
}
