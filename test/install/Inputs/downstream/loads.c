// Loads of core 0 that wait for one another: all lanes of one line after the
// other, or as SCATTER of lines of their own.
#include <vorion.h>

enum { Lines = 4096, Words = 16 };
static volatile unsigned Memory[Lines * Words];

int main(void) {
  if (vx_core_id() != 0)
    return 0;
#ifdef SCATTER
  const unsigned Used = Lines, Step = 4 * vx_thread_id() + 1;
#else
  const unsigned Used = 128, Step = 1;
#endif
  unsigned At = 0;
  for (unsigned N = 0; N != 1000; ++N)
    At = (At * 5 + Step + Memory[At * Words]) % Used;
  return 0;
}
