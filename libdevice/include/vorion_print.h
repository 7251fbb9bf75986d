/* Text from the device, for C programs and for the OpenCL library's printf.
   With a launch block text is appended to its print buffer, whole texts in
   (core, lane) order; without one it goes to the console, lane after lane. */
#ifndef VORION_PRINT_H
#define VORION_PRINT_H

#include <stdarg.h>
#include <stddef.h>

/* As in C17 7.21.6. Malformed conversions end the text and give -1; so does
   text that does not fit the print buffer. */
int printf(const char *format, ...) __attribute__((format(printf, 1, 2)));
int snprintf(char *text, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
int puts(const char *text);
int putchar(int c);

/* As in OpenCL C 6.15.14. 0, or -1 for what printf gives -1 for. */
int vx_vprintf_opencl(const char *format, va_list arguments);

#endif
