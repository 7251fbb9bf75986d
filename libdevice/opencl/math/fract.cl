// fract(x, whole). PoCL's, for devices without doubles, gives 0x1.fffffep-1
// for an infinity, which made pow(-0, inf) an odd power. Of -0 it gives +0.
#include "templates.h"

DEFINE_EXPR_V_VPV (fract, ({
                     *b = floor (a);
                     stype below_one = TYPED_CONST (
                         stype, 0x1.ffcp-1, 0x1.fffffep-1f, 0x1.fffffffffffffp-1);
                     vtype part = fmin (a - floor (a), (vtype)below_one);
                     part = select (part, copysign ((vtype)0, a),
                                    (itype)(isinf (a) | (a == (vtype)0)));
                     select (part, a, (itype)isnan (a));
                   }))
