#ifndef STDLIB_H
#define STDLIB_H
#include <stddef.h>
__attribute__((noreturn)) void abort(void);
__attribute__((noreturn)) void exit(int code);
void *malloc(size_t size);
void *calloc(size_t count, size_t size);
void *realloc(void *block, size_t size);
void free(void *block);
int abs(int number);
#define alloca __builtin_alloca
#endif
