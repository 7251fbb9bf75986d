/* Copies of a group, by all of its work-items together. They have ended for all
   of them when wait_group_events() returns (events.cl). */

#include "templates.h"

/* From and to: the places of an element, by its number k. */
#define COPY(NAME, TO_SPACE, FROM_SPACE, TYPE, STRIDE, TO, FROM)               \
  event_t _CL_OVERLOADABLE NAME(TO_SPACE TYPE *to, const FROM_SPACE TYPE *from,\
                                size_t count STRIDE, event_t event) {          \
    for (size_t k = get_local_linear_id(),                                     \
                step = get_local_size(0) * get_local_size(1) *                 \
                       get_local_size(2);                                      \
         k < count; k += step)                                                 \
      to[TO] = from[FROM];                                                     \
    return event;                                                              \
  }

#define AND_STRIDE , size_t stride
#define COPIES_OF(TYPE)                                                        \
  COPY(async_work_group_copy, local, global, TYPE, , k, k)                     \
  COPY(async_work_group_copy, global, local, TYPE, , k, k)                     \
  COPY(async_work_group_strided_copy, local, global, TYPE, AND_STRIDE, k,      \
       k *stride)                                                              \
  COPY(async_work_group_strided_copy, global, local, TYPE, AND_STRIDE,         \
       k *stride, k)

#define COPIES(TYPE)                                                           \
  COPIES_OF(TYPE)                                                              \
  COPIES_OF(TYPE##2)                                                           \
  COPIES_OF(TYPE##3)                                                           \
  COPIES_OF(TYPE##4)                                                           \
  COPIES_OF(TYPE##8)                                                           \
  COPIES_OF(TYPE##16)

COPIES(char)
COPIES(uchar)
COPIES(short)
COPIES(ushort)
COPIES(int)
COPIES(uint)
COPIES(long)
COPIES(ulong)
COPIES(float)
COPIES(double)
COPIES(half)
