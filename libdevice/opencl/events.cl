/* Each work-item of the group has done its part of the copies before any goes
   on (async_copies.cl). */

#define IN_ALL_MEMORY (CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE)

void _CL_OVERLOADABLE wait_group_events(int count, private event_t *events) {
  work_group_barrier(IN_ALL_MEMORY);
}

void _CL_OVERLOADABLE wait_group_events(int count, generic event_t *events) {
  work_group_barrier(IN_ALL_MEMORY);
}
