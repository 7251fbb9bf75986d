// nan(code): a quiet NaN with the code in its other bits. PoCL's does not set the
// quiet bit, and has no room for a double's code.
#define USING_ASTYPE_HELPERS
#include "templates.h"

DEFINE_EXPR_V_U (nan, ({
                   const sutype quiet = TYPED_CONST (
                       sutype, 0x7e00, 0x7fc00000, 0x7ff8000000000000);
                   const utype code = a & (utype)((quiet & -quiet) - 1);
                   const utype val = code | quiet;
                   _cl_nan_as_vtype (val);
                 }))
