# Where each math function of OpenCL C comes from, by the file that defines it: sin() is sin.cl.
# A function that no list names is PoCL's own, in lib/kernel/ of its sources.

# Two libraries that PoCL's sources bring along. Neither calls libm.
set(FROM_LIBCLC
    acosh acospi asinh asinpi atan2pi atanh atanpi cos cosh cospi degrees fmod
    isfinite isinf isnan isnormal log2 logb pow pown powr radians remainder
    remquo rootn sin sincos sinh sinpi tan tanh tanpi)
set(FROM_SLEEF
    acos asin atan atan2 cbrt erf erfc exp exp10 exp2 expm1 fdim frexp hypot
    ilogb ldexp lgamma log log10 log1p modf native_cos native_sin native_tan
    nextafter)
# What these need besides.
set(LIBCLC_HELPERS ep_log ocml_helpers pocl_fma pow_helpers sincos_helpers)
set(SLEEF_HELPERS expfrexp frfrexp lgamma_r)

# Of this folder.
set(OWN_MATH fma fract ldexp_scalar rsqrt nan tgamma)
