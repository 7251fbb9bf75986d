// Functions that are called, not inlined, with all that C passes: structures,
// small and large, and vectors, in and out; pointers to functions, in which
// lanes agree; arguments without declared types; on paths that lanes take apart.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf && vorion-sim %t.elf | sort -n > %t.device
// RUN: clang-19 -O1 -ffp-contract=off %s -o %t.host.exe && %t.host.exe | sort -n > %t.host
// RUN: diff %t.host %t.device
// RUN: FileCheck %s < %t.device
// RUN: vorion-clang -O0 %s -o %t.O0.elf && vorion-sim %t.O0.elf | sort -n > %t.O0.device
// RUN: diff %t.host %t.O0.device
// RUN: vorion-clang -Os %s -o %t.Os.elf && vorion-sim %t.Os.elf | sort -n > %t.Os.device
// RUN: diff %t.host %t.Os.device
#include "../libdevice/Inputs/items.h"

#include <stdarg.h>

#define APART __attribute__((noinline))

typedef struct {
  int a;
  float b;
} pair;
typedef struct {
  uint32_t words[7];
  pair last;
} record;
typedef float float4 __attribute__((vector_size(16)));
typedef short short4 __attribute__((vector_size(8)));

APART static pair swap_pair(pair p) {
  const pair q = {(int)p.b, (float)p.a};
  return q;
}

APART static record rotate(record r, uint32_t by) {
  record s = r;
  for (uint32_t k = 0; k < 7; ++k)
    s.words[k] = r.words[(k + by) % 7];
  if (by & 1)
    s.last = swap_pair(r.last);
  return s;
}

APART static float4 scale(float4 v, float by) {
  return by > 3.0f ? v * by : v + by;
}

APART static short4 bits(short4 v, short by) { return (v << (by & 7)) ^ by; }

/* Each lane calls itself to a depth of its own. */
APART static uint32_t depth(uint32_t n) {
  if (n % 5 == 0)
    return n;
  return depth(n - 1) * 3 + n;
}

APART static int sum(int count, ...) {
  va_list list;
  va_start(list, count);
  int total = 0;
  for (int k = 0; k < count; ++k)
    total += k % 3 == 2 ? (int)va_arg(list, double) : va_arg(list, int);
  va_end(list);
  return total;
}

APART static uint32_t plus(uint32_t x) { return x + 7; }
APART static uint32_t times(uint32_t x) { return x % 2 ? x * 7 : x + 1; }
typedef uint32_t (*unary)(uint32_t);
/* The same for all lanes: the machine's words are read by all. */
static unary volatile table[2] = {plus, times};

APART static uint32_t through(uint32_t which, uint32_t x) {
#ifdef __riscv_xvortex
  const unary f = (unary)vx_uniform((uint)table[which]);
#else
  const unary f = table[which];
#endif
  return x % 3 ? f(x) : x;
}

/* Each access happens, on the lanes that reach it and no others. */
APART static uint32_t volatiles(uint32_t i) {
  volatile uint32_t cell[2] = {i, 1};
  if (i % 4 == 1)
    cell[1] = cell[0] + cell[1];
  else if (i % 4 == 2)
    cell[0] = cell[0] * cell[1] + 3;
  while (cell[0] > 20)
    cell[0] -= 17 + cell[1] % 2;
  return cell[0] * 100 + cell[1];
}

void item(uint32_t i) {
  record r = {{i, i + 1, i + 2, i + 3, i * 5, i * 7, i * 11},
              {(int)i, (float)i * 0.5f}};
  if (i % 3 == 1)
    r = rotate(r, i % 7);
  float4 v = {(float)i, 1.0f, -2.0f, 0.25f};
  if (i & 4)
    v = scale(v, (float)(i % 6));
  short4 w = {(short)i, 1, 2, 7};
  w = i % 5 < 2 ? bits(w, (short)i) : w;
  const int total = i % 2 ? sum(3, (int)i, 4, 2.5 * i) : sum(1, (int)i);
  const uint32_t called = through(0, i) + through(1, i);
  printf("%u: %u %u %d %d, %d %d %d, %d %d, %u %d %u %u\n", (unsigned)i,
         (unsigned)r.words[0], (unsigned)r.words[6], r.last.a,
         (int)(r.last.b * 4), (int)v[0], (int)v[2], (int)(v[3] * 4), w[0], w[3],
         (unsigned)depth(i), total, (unsigned)called, (unsigned)volatiles(i));
  // CHECK: {{^}}7: 7 77 7 14, 8 -1 5, 7 7, 70 28 63 701{{$}}
}
