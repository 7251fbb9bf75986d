// printf of C programs, against the host; each lane prints other values. Lines
// are sorted: the lanes that reach one call print before any reaches the next.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf && vorion-sim %t.elf | env LC_ALL=C sort > %t.device
// RUN: clang-19 -O1 %s -o %t.host.exe && %t.host.exe | env LC_ALL=C sort > %t.host
// RUN: diff %t.host %t.device
#include "Inputs/items.h"

void item(uint32_t i) {
  uint64_t state = seed_of(i);
  const uint64_t a = next_operand(&state);
  const double x = (double)(int64_t)next_operand(&state) / 1e6;
  printf("%u: %d %5d|%-6u|%08x %#x %o %lld %llu %llx\n", (unsigned)i, (int)a,
         (int)i - 60, (unsigned)i, (unsigned)a, (unsigned)i, (unsigned)a,
         (long long)a, (unsigned long long)a, (unsigned long long)a);
  printf("%f %.3e %g %12.2f|%-10.1f|%a\n", x, x, x, (double)i, x / 1e9, x);
  if (i % 3 == 0)
    printf("%s %c %%\n", i % 2 ? "odd" : "even", (int)('a' + i % 26));
  else
    puts("a plain line");
  putchar('\n');
}
