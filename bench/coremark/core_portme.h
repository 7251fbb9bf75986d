/* CoreMark's settings for the machine, and for rv32 Linux programs under qemu
   (docs/tables/programs.md). CoreMark's porting guide says what each is. */
#ifndef CORE_PORTME_H
#define CORE_PORTME_H

#include <stddef.h>

#ifdef __riscv_xvortex
#include <vorion_print.h>
#define COMPILER_VERSION "vorion-clang " __clang_version__
#else
int printf(const char *format, ...);
#define COMPILER_VERSION __VERSION__
#endif
#define COMPILER_FLAGS FLAGS_STR
#define MEM_LOCATION "the stack"

#define HAS_FLOAT 1
#define HAS_TIME_H 0
#define USE_CLOCK 0
#define HAS_STDIO 0
#define HAS_PRINTF 1
#define SEED_METHOD SEED_VOLATILE
#define MEM_METHOD MEM_STACK
#define MULTITHREAD 1
#define MAIN_HAS_NOARGC 1
#define MAIN_HAS_NORETURN 0

typedef signed short ee_s16;
typedef unsigned short ee_u16;
typedef signed int ee_s32;
typedef float ee_f32;
typedef unsigned char ee_u8;
typedef unsigned int ee_u32;
typedef size_t ee_ptr_int;
typedef size_t ee_size_t;
typedef ee_u32 CORE_TICKS;

/* The next multiple of 4. */
#define align_mem(x) (void *)(((ee_ptr_int)(x) + 3) & ~(ee_ptr_int)3)

typedef struct CORE_PORTABLE_S {
  ee_u8 portable_id;
} core_portable;

extern ee_u32 default_num_contexts;
void portable_init(core_portable *port, int *argc, char *argv[]);
void portable_fini(core_portable *port);

#if !defined(PROFILE_RUN) && !defined(PERFORMANCE_RUN) &&                      \
    !defined(VALIDATION_RUN)
#define PERFORMANCE_RUN 1
#endif

#endif
