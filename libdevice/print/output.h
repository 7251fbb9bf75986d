/* Formatted text to where this program's text goes. */
#ifndef VX_OUTPUT_H
#define VX_OUTPUT_H

#include "format.h"

/* The number of bytes, or -1 (vorion_print.h says when). */
int vx_vprint(enum vx_dialect dialect, const char *format, va_list arguments);

#endif
