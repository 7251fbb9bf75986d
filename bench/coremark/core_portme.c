/* What CoreMark asks of a machine: seeds that no compiler knows, and the time.
 */
#include "coremark.h"

#if VALIDATION_RUN
enum { SEED_1 = 0x3415, SEED_2 = 0x3415, SEED_3 = 0x66 };
#elif PROFILE_RUN
enum { SEED_1 = 8, SEED_2 = 8, SEED_3 = 8 };
#else
enum { SEED_1 = 0, SEED_2 = 0, SEED_3 = 0x66 };
#endif
volatile ee_s32 seed1_volatile = SEED_1;
volatile ee_s32 seed2_volatile = SEED_2;
volatile ee_s32 seed3_volatile = SEED_3;
volatile ee_s32 seed4_volatile = ITERATIONS;
volatile ee_s32 seed5_volatile = 0; /* all algorithms */

ee_u32 default_num_contexts = 1;

void portable_init(core_portable *port, int *argc, char *argv[]) {
  (void)argc;
  (void)argv;
  port->portable_id = 1;
}

void portable_fini(core_portable *port) { port->portable_id = 0; }

/* Instructions on the machine, whose programs cannot read its modelled time;
   microseconds under Linux. */
CORE_TICKS now(void);
#ifdef __riscv_xvortex
enum { TICKS_PER_SECOND = 100000000 };
CORE_TICKS now(void) {
  CORE_TICKS count;
  __asm__ volatile("csrr %0, mcycle" : "=r"(count));
  return count;
}
#else
enum { TICKS_PER_SECOND = 1000000 };
#endif

static CORE_TICKS begin, end;

void start_time(void) { begin = now(); }

void stop_time(void) { end = now(); }

CORE_TICKS get_time(void) { return end - begin; }

secs_ret time_in_secs(CORE_TICKS ticks) {
  return (secs_ret)ticks / TICKS_PER_SECOND;
}
