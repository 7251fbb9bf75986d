// Calls through pointers reach the functions whose address is taken: there is
// stack for the one that needs most. What the pointers make of it, a recursion
// without an end, traps.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf
// RUN: vorion-sim %t.elf --kernel pointed --global 256 --local 16 --arg out:1024@%t.out --arg i32:1
// RUN: od -An -v -td4 -w4 %t.out | uniq -c | FileCheck %s
// CHECK: {{^ *256 +1$}}
// RUN: not vorion-sim %t.elf --kernel pointed --global 256 --local 16 --arg out:1024@%t.out --arg i32:2 2>&1 | FileCheck %s --check-prefix=TRAP
// TRAP: stack overflow
#include <vorion.h>

typedef uint function(uint key, uint which);

static function *pointer(uint which);

__attribute__((noinline)) static uint large(uint key, uint which) {
  volatile uint a[30000];
  uint bad = which != 1;
  for (uint i = 0; i < 30000; i += 101)
    a[i] = i * key;
  for (uint i = 0; i < 30000; i += 101)
    bad += a[i] != i * key;
  return bad;
}
__attribute__((noinline)) static uint small(uint key, uint which) {
  return key + which;
}
__attribute__((noinline)) static uint endless(uint key, uint which) {
  volatile uint a[10];
  a[key % 10] = key;
  return pointer(which)(key + 1, which) + a[key % 10];
}
static function *const functions[3] = {small, large, endless};

/* All lanes call the same. */
static function *pointer(uint which) {
  return (function *)vx_uniform((uint)functions[which]);
}

struct args {
  uint *out, which;
};

static void pointed(const void *packed, const vx_launch *launch, uint gx,
                    uint gy, uint gz) {
  const struct args *args = packed;
  const uint id = gx * launch->local_size[0] + vx_thread_id();
  args->out[id] = 1 + pointer(args->which)(id, args->which);
}

static const char name[] = "pointed", out[] = "out", which[] = "which";
static const vx_kernel_arg arguments[] = {
    {(uint)out, VX_ARG_GLOBAL, 0, 4},
    {(uint)which, VX_ARG_VALUE, 4, 4},
};
__attribute__((section("vorion_kernels"),
               used)) static const vx_kernel kernel = {
    (uint)name, (uint)pointed, (uint)arguments, 2, 8, 0, 0, {0, 0, 0}};
