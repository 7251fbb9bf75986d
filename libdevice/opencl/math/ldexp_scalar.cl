// ldexp of a vector with one exponent for all elements.
#include "templates.h"

DEFINE_EXPR_V_VI (ldexp, ldexp (a, (jtype)b))
