// The launch block, the arguments and the kernel table are a program's to read,
// not to write.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf
// RUN: vorion-sim %t.elf --kernel poke --global 64 --local 16 --arg i32:0 --arg i32:0
// RUN: sh -c 'for place in 1 2 3 4; do for way in 0 1 2 3; do for engine in interpreter translator; do vorion-sim %t.elf --set engine=$engine --kernel poke --global 64 --local 16 --arg i32:$place --arg i32:$way; echo ended with $?; done; done; done; true' > %t.txt 2>&1
// RUN: grep -c "store access fault" %t.txt | FileCheck %s
// RUN: grep -c "ended with 4" %t.txt | FileCheck %s
// CHECK: {{^32$}}
#include <vorion.h>

struct args {
  int place, way;
};

extern const vx_kernel __start_vorion_kernels[];

static uint place_of(const struct args *args, const vx_launch *launch) {
  switch (args->place) {
  case 1:
    return (uint)args;
  case 2:
    return (uint)&launch->entry;
  case 3: /* the last word */
    return (uint)(launch + launch->warps) - 4;
  default:
    return (uint)__start_vorion_kernels;
  }
}

static void poke(const void *packed, const vx_launch *launch, uint gx, uint gy,
                 uint gz) {
  const struct args *args = packed;
  if (args->place == 0)
    return;
  const uint place = place_of(args, launch);
  switch (args->way) {
  case 0: /* all lanes at one place */
    *(volatile uint *)place = 0;
    break;
  case 1: /* side by side, with the first in memory that can be written */
    ((volatile uint *)place)[(int)vx_thread_id() - 8] = 0;
    break;
  case 2:
    *(volatile unsigned char *)(place + 3) = 0;
    break;
  default:
    __atomic_fetch_add((uint *)place, 1u, __ATOMIC_RELAXED);
  }
}

static const char name[] = "poke", place[] = "place", way[] = "way";
static const vx_kernel_arg arguments[] = {
    {(uint)place, VX_ARG_VALUE, 0, 4},
    {(uint)way, VX_ARG_VALUE, 4, 4},
};
__attribute__((section("vorion_kernels"),
               used)) static const vx_kernel kernel = {
    (uint)name, (uint)poke, (uint)arguments, 2, 8, 0, 0, {0, 0, 0}};
