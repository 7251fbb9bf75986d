// The group loop of the start-up code: every group is run once, by the core
// whose turn it is, with its own coordinates and the starting mask of its size.
// REQUIRES: vorion-clang, vorion-link, vorion-runtime
// RUN: vorion-clang -O2 %s -o %t.elf
// RUN: clang-19 -Wall -Wextra -Werror -I %root/runtime/include -I %include %S/Inputs/groups-host.c -L %build/lib -lvorion-runtime -Wl,-rpath,%build/lib -o %t.exe
// RUN: %t.exe %t.elf | FileCheck %s
// CHECK: 9 launches right
#include <vorion.h>

struct group {
  uint runs, gx, gy, gz, core, mask;
};
struct args {
  struct group *groups;
  uint *items;
};

static void visit(const void *packed, const vx_launch *launch, uint gx, uint gy,
                  uint gz) {
  const struct args *args = packed;
  const uint group =
      (gz * launch->num_groups[1] + gy) * launch->num_groups[0] + gx;
  struct group *record = &args->groups[group];
  const uint mask = vx_active_threads();
  const uint size =
      launch->local_size[0] * launch->local_size[1] * launch->local_size[2];
  /* Work-items by flattened id, as the compiler's work-item loop does. */
  for (uint item = vx_thread_id(); item < size; item += vx_num_threads())
    __atomic_fetch_add(&args->items[group], 1u, __ATOMIC_RELAXED);
  if (vx_thread_id() == 0) {
    record->runs += 1;
    record->gx = gx;
    record->gy = gy;
    record->gz = gz;
    record->core = vx_core_id();
    record->mask = mask;
  }
}

static const char name[] = "visit", groups[] = "groups", items[] = "items";
static const vx_kernel_arg arguments[] = {
    {(uint)groups, VX_ARG_GLOBAL, 0, 4},
    {(uint)items, VX_ARG_GLOBAL, 4, 4},
};
__attribute__((section("vorion_kernels"),
               used)) static const vx_kernel kernel = {
    (uint)name, (uint)visit, (uint)arguments, 2, 8, 0, 0, {0, 0, 0}};
