// printf of long double: the double nearest to it, against the host.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: clang-19 -O1 %s -o %t.host.exe && %t.host.exe | sort > %t.host
// RUN: vorion-clang -O2 -Werror %s -o %t.elf && vorion-sim %t.elf | sort > %t.device
// RUN: diff %t.host %t.device
#include "Inputs/items.h"

void item(uint32_t i) {
  uint64_t state = seed_of(i);
  const double x = (double)(int64_t)next_operand(&state) / 3e6;
  printf("%u: %Lf %.3Le %Lg|%12.2Lf|%-14.1LF|%d %s\n", (unsigned)i,
         (long double)x, (long double)x, (long double)i, (long double)x * 0.25L,
         (long double)-x, (int)i, "behind");
}
