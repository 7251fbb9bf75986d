/* What C programs that check themselves use of C's library, beyond what every
   image for the device has. Under Linux also what that has, and the start. */
#include <stdlib.h>
#include <string.h>

#ifdef __riscv_xvortex
#include <vorion.h>

void exit(int code) {
  *(volatile int *)VX_IO_EXIT = code;
  asm volatile("vx_tmc zero");
  for (;;)
    ;
}
#else
void exit(int code) {
  register int status asm("a0") = code;
  register int number asm("a7") = 93;
  for (;;)
    asm volatile("ecall" ::"r"(status), "r"(number));
}

asm(".globl _start\n"
    "_start: .option push\n"
    ".option norelax\n"
    "la gp, __global_pointer$\n"
    ".option pop\n"
    "li a0, 1\n"
    "call main\n"
    "call exit\n");

void *memcpy(void *to, const void *from, size_t size) {
  for (size_t i = 0; i < size; i++)
    ((char *)to)[i] = ((const char *)from)[i];
  return to;
}

void *memmove(void *to, const void *from, size_t size) {
  if ((char *)to < (const char *)from)
    return memcpy(to, from, size);
  while (size--)
    ((char *)to)[size] = ((const char *)from)[size];
  return to;
}

void *memset(void *to, int value, size_t size) {
  for (size_t i = 0; i < size; i++)
    ((char *)to)[i] = (char)value;
  return to;
}

int memcmp(const void *left, const void *right, size_t size) {
  const unsigned char *a = left, *b = right;
  for (; size && *a == *b; a++, b++)
    size--;
  return size ? *a - *b : 0;
}

size_t strlen(const char *text) {
  size_t length = 0;
  while (text[length])
    length++;
  return length;
}

/* Nothing is compared with what a program prints. */
int printf(const char *format, ...) { return 0; }
int puts(const char *text) { return 0; }
#endif

void abort(void) { exit(134); }

static char Heap[1 << 20];
static size_t Used;

void *malloc(size_t size) {
  char *block = Heap + Used;
  Used += (size + 15) & ~(size_t)15;
  return Used > sizeof Heap ? NULL : block;
}

void *calloc(size_t count, size_t size) {
  void *block = malloc(count * size);
  return block ? memset(block, 0, count * size) : NULL;
}

void *realloc(void *block, size_t size) {
  void *larger = malloc(size);
  return larger && block ? memcpy(larger, block, size) : larger;
}

void free(void *block) {}

int abs(int number) { return number < 0 ? -number : number; }

char *strcpy(char *to, const char *from) {
  memcpy(to, from, strlen(from) + 1);
  return to;
}

char *strncpy(char *to, const char *from, size_t size) {
  size_t i = 0;
  for (; i < size && from[i]; i++)
    to[i] = from[i];
  memset(to + i, 0, size - i);
  return to;
}

char *strcat(char *to, const char *from) {
  strcpy(to + strlen(to), from);
  return to;
}

int strncmp(const char *left, const char *right, size_t size) {
  for (; size && *left && *left == *right; left++, right++)
    size--;
  return size ? (unsigned char)*left - (unsigned char)*right : 0;
}

int strcmp(const char *left, const char *right) {
  return strncmp(left, right, (size_t)-1);
}

void *memchr(const void *block, int value, size_t size) {
  for (const char *at = block; size--; at++)
    if (*at == (char)value)
      return (void *)at;
  return NULL;
}

char *strchr(const char *text, int value) {
  return memchr(text, value, strlen(text) + 1);
}

char *strrchr(const char *text, int value) {
  char *last = NULL;
  for (; (text = strchr(text, value)); text++) {
    last = (char *)text;
    if (!*text)
      break;
  }
  return last;
}
