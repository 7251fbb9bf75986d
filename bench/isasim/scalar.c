/* A benchmark with one lane, REPEATS times: a Linux program for qemu-riscv32,
   with -DSPIKE a program for Spike, or with -DCOUNTED one for a machine of one
   lane, which counts instructions. Only the way out differs. */
#include "bench.h"

static char memory[BENCH_MEMORY] __attribute__((aligned(64)));
static char local[BENCH_LOCAL] __attribute__((aligned(64)));

void *bench_memory(void) { return memory; }
void *bench_local(void) { return local; }

#ifdef COUNTED
static void put(const char *text, uint32_t bytes) {
  for (uint32_t n = 0; n < bytes; ++n)
    *(volatile uint32_t *)0x40 = (uint8_t)text[n]; /* docs/abi.md */
}
__attribute__((noreturn)) static void leave(void) {
  __asm__ volatile(".insn r 0x0b, 0, 0, x0, x0, x0"); /* vx_tmc zero */
  __builtin_unreachable();
}
#elif defined(SPIKE)
/* Spike looks at these two by name. A call of its host's system lies in eight
   double words; an odd number ends the run. */
volatile uint64_t tohost __attribute__((aligned(64)));
volatile uint64_t fromhost __attribute__((aligned(64)));
static void put(const char *text, uint32_t bytes) {
  static volatile uint64_t call[8] __attribute__((aligned(64)));
  call[0] = 64; /* write */
  call[1] = 1;
  call[2] = (uint32_t)text;
  call[3] = bytes;
  __asm__ volatile("" ::"r"(text) : "memory"); /* the text is read, too */
  tohost = (uint32_t)call;
  while (fromhost == 0)
    ;
  fromhost = 0;
}
__attribute__((noreturn)) static void leave(void) {
  for (;;)
    tohost = 1;
}
#else
static long call(long number, long a, long b, long c) {
  register long a7 __asm__("a7") = number;
  register long a0 __asm__("a0") = a;
  register long a1 __asm__("a1") = b;
  register long a2 __asm__("a2") = c;
  __asm__ volatile("ecall" : "+r"(a0) : "r"(a7), "r"(a1), "r"(a2) : "memory");
  return a0;
}
static void put(const char *text, uint32_t bytes) {
  call(64, 1, (long)text, (long)bytes); /* write */
}
__attribute__((noreturn)) static void leave(void) {
  call(93, 0, 0, 0); /* exit */
  __builtin_unreachable();
}
#endif

__attribute__((noreturn, used)) void bench_start(void) {
  uint32_t result = 0;
  for (uint32_t n = 0; n < REPEATS; ++n)
    result = work(0, 1);
  char text[9];
  for (int n = 0; n < 8; ++n)
    text[n] = "0123456789abcdef"[result >> (28 - 4 * n) & 15];
  text[8] = '\n';
  put(text, sizeof(text));
  leave();
}

/* Linux has set sp; the machine's registers are 0. */
__asm__(".section .text.vorion_start, \"ax\", @progbits\n"
        ".globl _start\n"
        "_start:\n"
        "  bnez sp, 1f\n"
        "  li sp, 0xffff0000\n"
#ifdef SPIKE
        "  li t0, 0x2000\n" /* floats are off at first */
        "  csrs mstatus, t0\n"
#endif
        "1: j bench_start\n"
        ".text\n");
