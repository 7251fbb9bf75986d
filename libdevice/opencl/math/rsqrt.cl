/* Without half: half/half_math.cl rounds its quotient once. */
#undef __IF_FP16
#define __IF_FP16(x)
#include "templates.h"

DEFINE_EXPR_V_V(rsqrt, (vtype)1 / sqrt(a))
