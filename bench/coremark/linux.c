/* What a program needs under qemu-riscv32 without a C library: its start,
   memory functions, the time, and printf with the device's formatter. */
#include "format.h"

#include <stddef.h>

__asm__(".globl _start\n"
        "_start: .option push\n"
        ".option norelax\n"
        "la gp, __global_pointer$\n"
        ".option pop\n"
        "call main\n"
        "li a7, 93\n" /* exit */
        "ecall\n");

static long call(long number, long a, long b, long c) {
  register long a0 __asm__("a0") = a;
  register long a1 __asm__("a1") = b;
  register long a2 __asm__("a2") = c;
  register long a7 __asm__("a7") = number;
  __asm__ volatile("ecall" : "+r"(a0) : "r"(a1), "r"(a2), "r"(a7) : "memory");
  return a0;
}

void vx_put_console(char c) { call(64, 1, (long)&c, 1); /* write */ }

int printf(const char *format, ...) {
  struct vx_text text = {.console = 1};
  va_list list;
  va_start(list, format);
  const int result = vx_format(&text, VX_DIALECT_C, format, list);
  va_end(list);
  return result ? -1 : (int)text.count;
}

unsigned now(void);
unsigned now(void) {
  struct {
    long long seconds, nanoseconds;
  } time;
  call(403, 2, (long)&time, 0); /* clock_gettime64: of the process */
  return (unsigned)(time.seconds * 1000000 + time.nanoseconds / 1000);
}

void *memcpy(void *restrict to, const void *restrict from, size_t size) {
  for (size_t i = 0; i < size; ++i)
    ((char *)to)[i] = ((const char *)from)[i];
  return to;
}

void *memset(void *to, int value, size_t size) {
  for (size_t i = 0; i < size; ++i)
    ((char *)to)[i] = (char)value;
  return to;
}
