/* How many additions of 16 words this host does in a second of processor time
   at most: with one instruction of AVX-512 each, or with two of AVX2. No
   engine can execute more instructions of a warp that compute. Prints a line
   for each that the host has. */
#include <stdio.h>
#include <time.h>

enum { ROUNDS = 5, TIMES = 20000000, OPERATIONS = 8 };

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Eight of them that do not wait for each other. */
#define ADD(R) "vpaddd %%" R ", %%" R ", %%" R "\n"
#define WIDE(N) ADD("zmm" #N)
#define NARROW(N) ADD("ymm" #N)
#define LOOP(BODY, REGISTERS...)                                               \
  for (unsigned n = 0; n < TIMES; ++n)                                         \
  __asm__ volatile(BODY::: REGISTERS)

static void wide(void) {
  LOOP(WIDE(0) WIDE(1) WIDE(2) WIDE(3) WIDE(4) WIDE(5) WIDE(6) WIDE(7), "xmm0",
       "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7");
}
static void narrow(void) {
  LOOP(NARROW(0) NARROW(1) NARROW(2) NARROW(3) NARROW(4) NARROW(5) NARROW(6)
           NARROW(7) NARROW(8) NARROW(9) NARROW(10) NARROW(11) NARROW(12)
               NARROW(13) NARROW(14) NARROW(15),
       "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7", "xmm8",
       "xmm9", "xmm10", "xmm11", "xmm12", "xmm13", "xmm14", "xmm15");
}

static void measure(const char *name, void (*loop)(void)) {
  double least = 1e9;
  for (int round = 0; round < ROUNDS; ++round) {
    const double before = seconds();
    loop();
    const double taken = seconds() - before;
    if (taken < least)
      least = taken;
  }
  printf("%s %.0f\n", name, (double)TIMES * OPERATIONS / least);
}

int main(void) {
  if (__builtin_cpu_supports("avx2"))
    measure("translator-avx2", narrow);
  if (__builtin_cpu_supports("avx512f"))
    measure("translator", wide);
  return 0;
}
