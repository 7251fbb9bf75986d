/* Reductions and scans of a subgroup, of its active lanes, and of clusters of
   them.

   A scan takes as many rounds as the lanes' logarithm: in each, a lane joins
   what the lane that it points to has gathered, and then points where that one
   did. */
#include "subgroup/lanes.h"

/* What a reduction or scan is over: the lanes that take part, and for each of
   them the one before it. */
typedef struct {
  uint last, before;
} lane_list;

static lane_list lanes_of(uint mask) {
  return (lane_list){highest_lane(mask), lane_before(mask)};
}

/* All work-items of the subgroup. */
static lane_list whole_subgroup(void) {
  const uint lane = vx_thread_id();
  return (lane_list){get_sub_group_size() - 1, lane ? lane - 1 : NO_LANE};
}

/* The active lanes of the clusters of a power of two of lanes. */
static lane_list cluster_of(uint size) {
  const uint first = vx_thread_id() & ~(size - 1);
  return lanes_of(active_lanes() & lanes_below(first + size) &
                  ~lanes_below(first));
}

/* OP begins with an underscore: min and max are macros of PoCL. */
#define GATHER(OP, TYPE, JOINED)                                               \
  static TYPE _CL_OVERLOADABLE gather##OP(TYPE b, uint before) {               \
    const uint lanes = vx_num_threads();                                       \
    for (uint reach = 1; reach < lanes; reach *= 2) {                          \
      const TYPE a = from_lane(b, before);                                     \
      const TYPE joined = JOINED;                                              \
      b = before == NO_LANE ? b : joined;                                      \
      before = from_lane(before, before);                                      \
    }                                                                          \
    return b;                                                                  \
  }

#define OVER_LANES(PREFIX, OP, TYPE, NONE, LIST)                               \
  TYPE _CL_OVERLOADABLE PREFIX##_reduce##OP(TYPE value) {                      \
    const lane_list list = LIST;                                               \
    return from_lane(gather##OP(value, list.before), list.last);               \
  }                                                                            \
  TYPE _CL_OVERLOADABLE PREFIX##_scan_inclusive##OP(TYPE value) {              \
    return gather##OP(value, LIST.before);                                     \
  }                                                                            \
  TYPE _CL_OVERLOADABLE PREFIX##_scan_exclusive##OP(TYPE value) {              \
    const uint before = LIST.before;                                           \
    const TYPE all = from_lane(gather##OP(value, before), before);             \
    return before == NO_LANE ? (TYPE)(NONE) : all;                             \
  }

#define OVER_CLUSTER(OP, TYPE)                                                 \
  TYPE _CL_OVERLOADABLE sub_group_clustered_reduce##OP(TYPE value,             \
                                                       uint size) {            \
    const lane_list list = cluster_of(size);                                   \
    return from_lane(gather##OP(value, list.before), list.last);               \
  }

/* NONE: what joins with any value to that value. */
#define ANY_LANES(OP, TYPE, NONE, JOINED)                                      \
  GATHER(OP, TYPE, JOINED)                                                     \
  OVER_LANES(sub_group_non_uniform, OP, TYPE, NONE, lanes_of(active_lanes()))  \
  OVER_CLUSTER(OP, TYPE)

#define UNIFORM_TOO(OP, TYPE, NONE, JOINED)                                    \
  ANY_LANES(OP, TYPE, NONE, JOINED)                                            \
  OVER_LANES(sub_group, OP, TYPE, NONE, whole_subgroup())

#define ARITHMETIC(TYPE, LEAST, GREATEST, MIN, MAX)                            \
  UNIFORM_TOO(_add, TYPE, 0, a + b)                                            \
  UNIFORM_TOO(_min, TYPE, GREATEST, MIN(a, b))                                 \
  UNIFORM_TOO(_max, TYPE, LEAST, MAX(a, b))                                    \
  ANY_LANES(_mul, TYPE, 1, a *b)

#define INTEGER(TYPE, LEAST, GREATEST)                                         \
  ARITHMETIC(TYPE, LEAST, GREATEST, min, max)                                  \
  ANY_LANES(_and, TYPE, ~(TYPE)0, a &b)                                        \
  ANY_LANES(_or, TYPE, 0, a | b)                                               \
  ANY_LANES(_xor, TYPE, 0, a ^ b)

INTEGER(char, CHAR_MIN, CHAR_MAX)
INTEGER(uchar, 0, UCHAR_MAX)
INTEGER(short, SHRT_MIN, SHRT_MAX)
INTEGER(ushort, 0, USHRT_MAX)
INTEGER(int, INT_MIN, INT_MAX)
INTEGER(uint, 0, UINT_MAX)
INTEGER(long, LONG_MIN, LONG_MAX)
INTEGER(ulong, 0, ULONG_MAX)
#define FLOAT(TYPE) ARITHMETIC(TYPE, -INFINITY, INFINITY, fmin, fmax)
FOR_FLOATS(FLOAT)

/* A lane's own value becomes 0 or 1, too. */
#define LOGICAL(OP, NONE, JOINED)                                              \
  GATHER(OP##_of_truths, int, JOINED)                                          \
  static int gather##OP(int b, uint before) {                                  \
    return gather##OP##_of_truths(b != 0, before);                             \
  }                                                                            \
  OVER_LANES(sub_group_non_uniform, OP, int, NONE, lanes_of(active_lanes()))   \
  OVER_CLUSTER(OP, int)

LOGICAL(_logical_and, 1, a &&b)
LOGICAL(_logical_or, 0, a || b)
LOGICAL(_logical_xor, 0, a != b)
