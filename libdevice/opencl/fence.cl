/* Memory fences. A core's accesses are in order, so only what other cores see
   needs an instruction. */

static void fence(cl_mem_fence_flags flags) {
  if (flags & CLK_GLOBAL_MEM_FENCE)
    __atomic_thread_fence(__ATOMIC_SEQ_CST);
  else
    __atomic_signal_fence(__ATOMIC_SEQ_CST);
}

void _CL_OVERLOADABLE mem_fence(cl_mem_fence_flags flags) { fence(flags); }

void _CL_OVERLOADABLE read_mem_fence(cl_mem_fence_flags flags) { fence(flags); }

void _CL_OVERLOADABLE write_mem_fence(cl_mem_fence_flags flags) {
  fence(flags);
}

void _CL_OVERLOADABLE atomic_work_item_fence(cl_mem_fence_flags flags,
                                             memory_order order,
                                             memory_scope scope) {
  fence(flags);
}

void _CL_OVERLOADABLE work_group_barrier(cl_mem_fence_flags flags) {
  barrier(flags);
}

void _CL_OVERLOADABLE work_group_barrier(cl_mem_fence_flags flags,
                                         memory_scope scope) {
  barrier(flags);
}

/* address_space.c */
extern uint vorion_fence_of(const generic void *pointer);

cl_mem_fence_flags _CL_OVERLOADABLE get_fence(generic void *pointer) {
  return vorion_fence_of(pointer);
}

cl_mem_fence_flags _CL_OVERLOADABLE get_fence(const generic void *pointer) {
  return vorion_fence_of(pointer);
}
