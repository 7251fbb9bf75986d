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
