/* One work-item's value for the whole subgroup, scalars and vectors. */
#include "subgroup/lanes.h"

#define BROADCAST(NAME, TYPE)                                                  \
  TYPE _CL_OVERLOADABLE NAME(TYPE v, uint lane) { return from_lane(v, lane); } \
  TYPE##2 _CL_OVERLOADABLE NAME(TYPE##2 v, uint lane) {                        \
    return (TYPE##2)(NAME(v.x, lane), NAME(v.y, lane));                        \
  }                                                                            \
  TYPE##3 _CL_OVERLOADABLE NAME(TYPE##3 v, uint lane) {                        \
    return (TYPE##3)(NAME(v.xy, lane), NAME(v.z, lane));                       \
  }                                                                            \
  TYPE##4 _CL_OVERLOADABLE NAME(TYPE##4 v, uint lane) {                        \
    return (TYPE##4)(NAME(v.lo, lane), NAME(v.hi, lane));                      \
  }                                                                            \
  TYPE##8 _CL_OVERLOADABLE NAME(TYPE##8 v, uint lane) {                        \
    return (TYPE##8)(NAME(v.lo, lane), NAME(v.hi, lane));                      \
  }                                                                            \
  TYPE##16 _CL_OVERLOADABLE NAME(TYPE##16 v, uint lane) {                      \
    return (TYPE##16)(NAME(v.lo, lane), NAME(v.hi, lane));                     \
  }

#define UNIFORM(TYPE) BROADCAST(sub_group_broadcast, TYPE)
#define NON_UNIFORM(TYPE) BROADCAST(sub_group_non_uniform_broadcast, TYPE)
FOR_NUMBERS(UNIFORM)
FOR_NUMBERS(NON_UNIFORM)
