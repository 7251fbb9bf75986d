/* The end of a program before main() returns. A warp ends as a whole, as a
   process ends with all its threads: lanes that wait elsewhere cannot go on
   without those that they wait for. Other cores go on. */
#include <vorion.h>

void vx_end_static_objects(int destroys); /* cxx/static_objects.c */

#define REPLACEABLE __attribute__((weak))

/* Of start/vorion.ld. */
extern void (*const vorion_constructors[])(void);
extern void (*const vorion_constructors_end[])(void);
extern void (*const vorion_destructors[])(void);
extern void (*const vorion_destructors_end[])(void);

/* Set behind the constructors (cxx/static_objects.c). */
volatile int vx_is_constructed;

/* All lanes come here, each with the registers that it had: they share nothing
   but the code, and nothing returns. */
__attribute__((noinline)) static void end_warp(int destroys) {
  void (*const *begin)(void) = vorion_constructors;
  void (*const *end)(void) = vorion_destructors;
  /* Without such objects, no core waits for another (start/vorion.ld). */
  if (begin != vorion_constructors_end || end != vorion_destructors_end) {
    if (!vx_is_constructed) { /* the others wait for a constructor */
      vx_is_constructed = 1;
      vx_bar(1u << 31, vx_num_cores());
    }
    vx_end_static_objects(destroys);
  }
  vx_tmc(0);
}

static void store_exit_code(int code) { *(volatile int *)VX_IO_EXIT = code; }

/* Inline: the other lanes have other places to return to. */
__attribute__((always_inline)) static inline void activate_all_lanes(void) {
  vx_tmc(~0u >> (32 - vx_num_threads()));
}

REPLACEABLE _Noreturn void exit(int code) {
  store_exit_code(code);
  activate_all_lanes();
  end_warp(1);
  __builtin_unreachable();
}

REPLACEABLE _Noreturn void _Exit(int code) {
  store_exit_code(code);
  activate_all_lanes();
  end_warp(0);
  __builtin_unreachable();
}

/* Is reported with its address. */
REPLACEABLE _Noreturn void abort(void) { __builtin_trap(); }
