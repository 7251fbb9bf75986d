/* Every work-item of a subgroup takes the value of one that it chooses. */
#include "subgroup/lanes.h"

/* A rotation stays within clusters of a power of two of lanes. */
static uint rotated(int delta, uint cluster) {
  const uint lane = vx_thread_id(), within = cluster - 1;
  return (lane & ~within) | ((lane + delta) & within);
}

#define SHUFFLES(TYPE)                                                         \
  TYPE _CL_OVERLOADABLE sub_group_shuffle(TYPE value, uint lane) {             \
    return from_lane(value, lane);                                             \
  }                                                                            \
  TYPE _CL_OVERLOADABLE sub_group_shuffle_xor(TYPE value, uint mask) {         \
    return from_lane(value, vx_thread_id() ^ mask);                            \
  }                                                                            \
  TYPE _CL_OVERLOADABLE sub_group_shuffle_up(TYPE value, uint delta) {         \
    return from_lane(value, vx_thread_id() - delta);                           \
  }                                                                            \
  TYPE _CL_OVERLOADABLE sub_group_shuffle_down(TYPE value, uint delta) {       \
    return from_lane(value, vx_thread_id() + delta);                           \
  }                                                                            \
  TYPE _CL_OVERLOADABLE sub_group_rotate(TYPE value, int delta) {              \
    return from_lane(value, (vx_thread_id() + delta) %                         \
                                (uint)get_max_sub_group_size());               \
  }                                                                            \
  TYPE _CL_OVERLOADABLE sub_group_clustered_rotate(TYPE value, int delta,      \
                                                   uint cluster) {             \
    return from_lane(value, rotated(delta, cluster));                          \
  }
FOR_NUMBERS(SHUFFLES)
