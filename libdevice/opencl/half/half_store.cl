/* vstoren() of halves: PoCL's stores through generic pointers only. */

#include "half/vectors.h"

#define STORE(N, SPACE)                                                        \
  void _CL_OVERLOADABLE vstore##N(half##N value, size_t offset,                \
                                  SPACE half *p) {                             \
    vstore##N(as_ushort##N(value), offset, (SPACE ushort *)p);                 \
  }
FOR_VECTORS(STORE, global)
FOR_VECTORS(STORE, local)
FOR_VECTORS(STORE, private)
