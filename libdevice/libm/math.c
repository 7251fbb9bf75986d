/* The C names of single-precision functions, for C programs and for what the
   compiler calls by itself. The work is done by instructions where there are
   some, else by SLEEF, whose sources come with PoCL's. */

#include "trig_large.h"

/* Compiled with -fno-math-errno, these builtins are instructions. */
float sqrtf(float x) { return __builtin_sqrtf(x); }
float fmaf(float x, float y, float z) { return __builtin_fmaf(x, y, z); }
float fabsf(float x) { return __builtin_fabsf(x); }
float copysignf(float x, float y) { return __builtin_copysignf(x, y); }
float fminf(float x, float y) { return __builtin_fminf(x, y); }
float fmaxf(float x, float y) { return __builtin_fmaxf(x, y); }

#define FROM_SLEEF(name, sleef)                                                \
  float sleef(float x);                                                        \
  float name(float x) { return sleef(x); }
#define FROM_SLEEF_2(name, sleef, type)                                        \
  float sleef(float x, type y);                                                \
  float name(float x, type y) { return sleef(x, y); }

/* SLEEF reduces these with four floats of pi, right up to about 39000. */
#define TRIGONOMETRIC(name, sleef)                                             \
  float sleef(float x);                                                        \
  float name(float x) {                                                        \
    const float size = __builtin_fabsf(x);                                     \
    return size >= LARGE_ANGLE && size <= __FLT_MAX__ ? large_##name(x)        \
                                                      : sleef(x);              \
  }

TRIGONOMETRIC(sinf, Sleef_sinf_u10)
TRIGONOMETRIC(cosf, Sleef_cosf_u10)
TRIGONOMETRIC(tanf, Sleef_tanf_u10)
FROM_SLEEF(asinf, Sleef_asinf_u10)
FROM_SLEEF(acosf, Sleef_acosf_u10)
FROM_SLEEF(atanf, Sleef_atanf_u10)
FROM_SLEEF_2(atan2f, Sleef_atan2f_u10, float)
FROM_SLEEF(sinhf, Sleef_sinhf_u10)
FROM_SLEEF(coshf, Sleef_coshf_u10)
FROM_SLEEF(tanhf, Sleef_tanhf_u10)
FROM_SLEEF(expf, Sleef_expf_u10)
FROM_SLEEF(exp2f, Sleef_exp2f_u10)
FROM_SLEEF(exp10f, Sleef_exp10f_u10)
FROM_SLEEF(expm1f, Sleef_expm1f_u10)
FROM_SLEEF(logf, Sleef_logf_u10)
FROM_SLEEF(log2f, Sleef_log2f_u10)
FROM_SLEEF(log10f, Sleef_log10f_u10)
FROM_SLEEF(log1pf, Sleef_log1pf_u10)
FROM_SLEEF_2(powf, Sleef_powf_u10, float)
FROM_SLEEF(cbrtf, Sleef_cbrtf_u10)
FROM_SLEEF_2(hypotf, Sleef_hypotf_u05, float)
FROM_SLEEF_2(fmodf, Sleef_fmodf, float)
FROM_SLEEF_2(ldexpf, Sleef_ldexpf, int)
FROM_SLEEF(floorf, Sleef_floorf)
FROM_SLEEF(ceilf, Sleef_ceilf)
FROM_SLEEF(truncf, Sleef_truncf)
FROM_SLEEF(roundf, Sleef_roundf)
FROM_SLEEF(rintf, Sleef_rintf)
FROM_SLEEF(nearbyintf, Sleef_rintf)
FROM_SLEEF(roundevenf, Sleef_rintf)
