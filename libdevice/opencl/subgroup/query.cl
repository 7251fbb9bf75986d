/* Which subgroup of its group a work-item is in, and where in it. */
#include "subgroup/lanes.h"

static uint group_items(void) {
  return get_local_size(0) * get_local_size(1) * get_local_size(2);
}

uint _CL_OVERLOADABLE get_sub_group_local_id(void) { return vx_thread_id(); }

uint _CL_OVERLOADABLE get_sub_group_id(void) {
  return get_local_linear_id() / vx_num_threads();
}

/* Of all groups but the last. */
static uint enqueued_items(void) {
  return get_enqueued_local_size(0) * get_enqueued_local_size(1) *
         get_enqueued_local_size(2);
}

uint _CL_OVERLOADABLE get_max_sub_group_size(void) {
  return min(vx_num_threads(), enqueued_items());
}

uint _CL_OVERLOADABLE get_sub_group_size(void) {
  const uint lanes = vx_num_threads();
  return min(lanes, group_items() - get_sub_group_id() * lanes);
}

uint _CL_OVERLOADABLE get_num_sub_groups(void) {
  const uint lanes = vx_num_threads();
  return (group_items() + lanes - 1) / lanes;
}

uint _CL_OVERLOADABLE get_enqueued_num_sub_groups(void) {
  const uint lanes = vx_num_threads();
  return (enqueued_items() + lanes - 1) / lanes;
}

/* The lanes of a warp step together, and a core's accesses are in order, so that
   it takes no instruction. The empty assembly is convergent, which no fence of
   LLVM is: it keeps the lanes together here, and accesses on their side. */
void _CL_OVERLOADABLE sub_group_barrier(cl_mem_fence_flags flags) {
  __asm__ volatile("" ::: "memory");
  mem_fence(flags);
}

void _CL_OVERLOADABLE sub_group_barrier(cl_mem_fence_flags flags,
                                        memory_scope scope) {
  sub_group_barrier(flags);
}
