/* Functions that a whole group calls together (work_group_reduce_add() and its
   kin): each subgroup makes one value, and all go through these. */
#include "subgroup/lanes.h"

/* 8 bytes of local memory for each subgroup of the largest group; the driver
   gives it its place when a kernel is finished. */
extern local void *vorion_group_scratch(void);

static uint group_lane(size_t x, size_t y, size_t z) {
  return x + get_local_size(0) * (y + get_local_size(1) * z);
}

#define BROADCAST(TYPE)                                                        \
  static TYPE _CL_OVERLOADABLE broadcast(TYPE value, uint item) {              \
    local TYPE *scratch = vorion_group_scratch();                              \
    if (get_local_linear_id() == item)                                         \
      *scratch = value;                                                        \
    work_group_barrier(CLK_LOCAL_MEM_FENCE);                                   \
    const TYPE found = *scratch;                                               \
    work_group_barrier(CLK_LOCAL_MEM_FENCE);                                   \
    return found;                                                              \
  }                                                                            \
  TYPE _CL_OVERLOADABLE work_group_broadcast(TYPE value, size_t x) {           \
    return broadcast(value, group_lane(x, 0, 0));                              \
  }                                                                            \
  TYPE _CL_OVERLOADABLE work_group_broadcast(TYPE value, size_t x, size_t y) { \
    return broadcast(value, group_lane(x, y, 0));                              \
  }                                                                            \
  TYPE _CL_OVERLOADABLE work_group_broadcast(TYPE value, size_t x, size_t y,   \
                                             size_t z) {                       \
    return broadcast(value, group_lane(x, y, z));                              \
  }

/* all: of every subgroup; before: of those before the work-item's. */
#define COLLECTIVE(OP, TYPE, NONE, JOINED)                                     \
  typedef struct {                                                             \
    TYPE before, all;                                                          \
  } of##OP##_##TYPE;                                                           \
  static of##OP##_##TYPE _CL_OVERLOADABLE subgroups##OP(TYPE value) {          \
    local TYPE *scratch = vorion_group_scratch();                              \
    const uint own = get_sub_group_id(), count = get_num_sub_groups();         \
    const TYPE reduced = sub_group_reduce##OP(value);                          \
    if (get_sub_group_local_id() == 0)                                         \
      scratch[own] = reduced;                                                  \
    work_group_barrier(CLK_LOCAL_MEM_FENCE);                                   \
    of##OP##_##TYPE found = {NONE, NONE};                                      \
    for (uint i = 0; i < count; ++i) {                                         \
      const TYPE a = found.all, b = scratch[i];                                \
      found.before = i == own ? a : found.before;                              \
      found.all = JOINED;                                                      \
    }                                                                          \
    work_group_barrier(CLK_LOCAL_MEM_FENCE);                                   \
    return found;                                                              \
  }                                                                            \
  TYPE _CL_OVERLOADABLE work_group_reduce##OP(TYPE value) {                    \
    return subgroups##OP(value).all;                                           \
  }                                                                            \
  TYPE _CL_OVERLOADABLE work_group_scan_inclusive##OP(TYPE value) {            \
    const TYPE a = subgroups##OP(value).before;                                \
    const TYPE b = sub_group_scan_inclusive##OP(value);                        \
    return JOINED;                                                             \
  }                                                                            \
  TYPE _CL_OVERLOADABLE work_group_scan_exclusive##OP(TYPE value) {            \
    const TYPE a = subgroups##OP(value).before;                                \
    const TYPE b = sub_group_scan_exclusive##OP(value);                        \
    return JOINED;                                                             \
  }

#define COLLECTIVES(TYPE, LEAST, GREATEST, MIN, MAX)                           \
  BROADCAST(TYPE)                                                              \
  COLLECTIVE(_add, TYPE, 0, a + b)                                             \
  COLLECTIVE(_min, TYPE, GREATEST, MIN(a, b))                                  \
  COLLECTIVE(_max, TYPE, LEAST, MAX(a, b))

COLLECTIVES(int, INT_MIN, INT_MAX, min, max)
COLLECTIVES(uint, 0, UINT_MAX, min, max)
COLLECTIVES(long, LONG_MIN, LONG_MAX, min, max)
COLLECTIVES(ulong, 0, ULONG_MAX, min, max)
#define FLOAT(TYPE) COLLECTIVES(TYPE, -INFINITY, INFINITY, fmin, fmax)
FOR_FLOATS(FLOAT)

int _CL_OVERLOADABLE work_group_all(int predicate) {
  return work_group_reduce_min(predicate != 0);
}
int _CL_OVERLOADABLE work_group_any(int predicate) {
  return work_group_reduce_max(predicate != 0);
}
