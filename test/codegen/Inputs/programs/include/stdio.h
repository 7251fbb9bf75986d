#ifndef STDIO_H
#define STDIO_H
#include <stddef.h>
int printf(const char *format, ...);
int puts(const char *text);
#endif
