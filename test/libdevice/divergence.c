// Control flow that differs from lane to lane, against the host.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf && vorion-sim %t.elf | sort -n > %t.device
// RUN: clang-19 -O1 %s -o %t.host.exe && %t.host.exe | sort -n > %t.host
// RUN: diff %t.host %t.device
// RUN: FileCheck %s < %t.device
// RUN: vorion-clang -O0 %s -o %t.O0.elf && vorion-sim %t.O0.elf | sort -n > %t.O0.device
// RUN: diff %t.host %t.O0.device
// RUN: vorion-clang -Os %s -o %t.Os.elf && vorion-sim %t.Os.elf | sort -n > %t.Os.device
// RUN: diff %t.host %t.Os.device
#include "Inputs/items.h"

static int collatz(uint32_t n) {
  int steps = 0;
  while (n != 1) {
    n = n % 2 ? 3 * n + 1 : n / 2;
    ++steps;
  }
  return steps;
}

static int breaks_and_continues(uint32_t i) {
  int sum = 0;
  for (uint32_t k = 0; k < 50; ++k) {
    if ((k ^ i) % 3 == 0)
      continue;
    for (uint32_t m = k; m < k + i % 7; ++m) {
      if (m % 5 == i % 5)
        break;
      sum += (int)m;
    }
    if (sum > (int)(100 + 10 * i))
      break;
    sum += (int)k;
  }
  return sum;
}

static int switches(uint32_t i) {
  int value = 0;
  for (uint32_t k = 0; k < 6; ++k) {
    switch ((i + k) % 8) {
    case 0:
      value += 3;
      break;
    case 1:
      value *= 2; /* falls through */
    case 2:
      value -= 1;
      break;
    case 5:
      value ^= 0x55;
      break;
    case 6:
      return value + 1000;
    default:
      value += (int)k;
    }
  }
  return value;
}

__attribute__((noinline)) static int recursion(uint32_t n) {
  return n < 2 ? (int)n : recursion(n - 1) + recursion(n - 2);
}

static int early_returns(uint32_t i) {
  if (i % 2) {
    if (i % 3 == 0)
      return 1;
    for (uint32_t k = 1;; ++k)
      if (k * k > i)
        return (int)k;
  }
  if (i > 60 && (i & 4 || i & 8))
    return -1;
  return i % 4 == 0 ? 7 : (int)(i / 2);
}

/* Two entries into one loop. */
static int irreducible(uint32_t i) {
  int count = 0;
  uint32_t n = i;
  if (i % 2)
    goto middle;
top:
  n += 3;
  ++count;
middle:
  n += 5;
  count += 10;
  if (n < 100 + 3 * (i % 16))
    goto top;
  return count * 1000 + (int)n;
}

void item(uint32_t i) {
  printf("%u: %d %d %d %d %d %d\n", (unsigned)i, collatz(i + 1),
         breaks_and_continues(i), switches(i), recursion(i % 13),
         early_returns(i), irreducible(i));
}
// The lengths are known: https://oeis.org/A006577
// CHECK: {{^}}0: 0 {{.*}}
// CHECK-NEXT: 1: 1 {{.*}}
// CHECK-NEXT: 2: 7 {{.*}}
// CHECK-NEXT: 3: 2 {{.*}}
// CHECK: 26: 111 {{.*}}
// CHECK: 127: 7 {{.*}}
