#include "Functions.h"

#include <limits>

namespace vorion::test {

namespace {

constexpr double None = std::numeric_limits<double>::infinity();

/// OpenCL's angles in half turns are MPFR's in two parts of a turn.
constexpr unsigned long HalfTurns = 2;

#define OF_ONE(FUNCTION)                                                       \
  [](mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr, mpfr_srcptr) {                    \
    FUNCTION(R, X, MPFR_RNDN);                                                 \
  }
#define OF_ONE_IN_HALF_TURNS(FUNCTION)                                         \
  [](mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr, mpfr_srcptr) {                    \
    FUNCTION(R, X, HalfTurns, MPFR_RNDN);                                      \
  }
#define OF_TWO(FUNCTION)                                                       \
  [](mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr Y, mpfr_srcptr) {                  \
    FUNCTION(R, X, Y, MPFR_RNDN);                                              \
  }
#define TO_WHOLE(FUNCTION)                                                     \
  [](mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr, mpfr_srcptr) { FUNCTION(R, X); }

long wholeOf(mpfr_srcptr Y) { return mpfr_get_si(Y, MPFR_RNDZ); }

void atan2pi(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr Y, mpfr_srcptr) {
  mpfr_atan2u(R, X, Y, HalfTurns, MPFR_RNDN);
}
void fma(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr Y, mpfr_srcptr Z) {
  mpfr_fma(R, X, Y, Z, MPFR_RNDN);
}
void ldexp(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr Y, mpfr_srcptr) {
  mpfr_mul_2si(R, X, wholeOf(Y), MPFR_RNDN);
}
void logb(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr, mpfr_srcptr) {
  if (mpfr_regular_p(X))
    mpfr_set_si(R, mpfr_get_exp(X) - 1, MPFR_RNDN);
  else if (mpfr_zero_p(X))
    mpfr_set_inf(R, -1);
  else
    mpfr_abs(R, X, MPFR_RNDN);
}
void lgamma(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr, mpfr_srcptr) {
  int Sign = 0;
  mpfr_lgamma(R, &Sign, X, MPFR_RNDN);
}
void pown(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr Y, mpfr_srcptr) {
  mpfr_pow_si(R, X, wholeOf(Y), MPFR_RNDN);
}
void rootn(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr Y, mpfr_srcptr) {
  mpfr_rootn_si(R, X, wholeOf(Y), MPFR_RNDN);
}
void reciprocal(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr, mpfr_srcptr) {
  mpfr_ui_div(R, 1, X, MPFR_RNDN);
}
/// Which zero fmin and fmax of zeros give is free, so it is made the positive
/// one.
void withoutSignOfZero(mpfr_ptr R) {
  if (mpfr_zero_p(R))
    mpfr_set_zero(R, 1);
}
void minimum(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr Y, mpfr_srcptr) {
  mpfr_min(R, X, Y, MPFR_RNDN);
  withoutSignOfZero(R);
}
void maximum(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr Y, mpfr_srcptr) {
  mpfr_max(R, X, Y, MPFR_RNDN);
  withoutSignOfZero(R);
}
void fraction(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr, mpfr_srcptr) {
  mpfr_frac(R, X, MPFR_RNDN);
}
void degrees(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr, mpfr_srcptr) {
  mpfr_const_pi(R, MPFR_RNDN);
  mpfr_ui_div(R, 180, R, MPFR_RNDN);
  mpfr_mul(R, X, R, MPFR_RNDN);
}
void radians(mpfr_ptr R, mpfr_srcptr X, mpfr_srcptr, mpfr_srcptr) {
  mpfr_const_pi(R, MPFR_RNDN);
  mpfr_div_ui(R, R, 180, MPFR_RNDN);
  mpfr_mul(R, X, R, MPFR_RNDN);
}

constexpr Range Any = Range::Any, Moderate = Range::Moderate,
                Unit = Range::Unit, NearOne = Range::NearOne,
                Positive = Range::Positive, AboveOne = Range::AboveOne,
                SmallInts = Range::SmallInts;

const MathFunction Functions[] = {
    {"x + y", "x + y", OF_TWO(mpfr_add), 0.5, 0.5, 0.5},
    {"x + y", "x + y", OF_TWO(mpfr_add), 0.5, 0.5, 0.5, Moderate, Moderate},
    {"x - y", "x - y", OF_TWO(mpfr_sub), 0.5, 0.5, 0.5},
    {"x - y", "x - y", OF_TWO(mpfr_sub), 0.5, 0.5, 0.5, NearOne, NearOne},
    {"x * y", "x * y", OF_TWO(mpfr_mul), 0.5, 0.5, 0.5},
    {"x / y", "x / y", OF_TWO(mpfr_div), 0.5, 2.5, 0.5},
    {"1 / x", "REAL(1) / x", reciprocal, 0.5, 2.5, 0.5},
    {"acos", "acos(x)", OF_ONE(mpfr_acos), 2, 4, 4},
    {"acos", "acos(x)", OF_ONE(mpfr_acos), 2, 4, 4, Unit},
    {"acosh", "acosh(x)", OF_ONE(mpfr_acosh), 2, 4, 4},
    {"acosh", "acosh(x)", OF_ONE(mpfr_acosh), 2, 4, 4, AboveOne},
    {"acosh", "acosh(x)", OF_ONE(mpfr_acosh), 2, 4, 4, NearOne},
    {"acospi", "acospi(x)", OF_ONE_IN_HALF_TURNS(mpfr_acosu), 2, 5, 5},
    {"acospi", "acospi(x)", OF_ONE_IN_HALF_TURNS(mpfr_acosu), 2, 5, 5, Unit},
    {"asin", "asin(x)", OF_ONE(mpfr_asin), 2, 4, 4},
    {"asin", "asin(x)", OF_ONE(mpfr_asin), 2, 4, 4, Unit},
    {"asinh", "asinh(x)", OF_ONE(mpfr_asinh), 2, 4, 4},
    {"asinh", "asinh(x)", OF_ONE(mpfr_asinh), 2, 4, 4, Moderate},
    {"asinpi", "asinpi(x)", OF_ONE_IN_HALF_TURNS(mpfr_asinu), 2, 5, 5},
    {"asinpi", "asinpi(x)", OF_ONE_IN_HALF_TURNS(mpfr_asinu), 2, 5, 5, Unit},
    {"atan", "atan(x)", OF_ONE(mpfr_atan), 2, 5, 5},
    {"atan", "atan(x)", OF_ONE(mpfr_atan), 2, 5, 5, Moderate},
    {"atan2", "atan2(x, y)", OF_TWO(mpfr_atan2), 2, 6, 6},
    {"atan2", "atan2(x, y)", OF_TWO(mpfr_atan2), 2, 6, 6, Moderate, Moderate},
    {"atan2pi", "atan2pi(x, y)", atan2pi, 2, 6, 6},
    {"atan2pi", "atan2pi(x, y)", atan2pi, 2, 6, 6, Moderate, Moderate},
    {"atanh", "atanh(x)", OF_ONE(mpfr_atanh), 2, 5, 5},
    {"atanh", "atanh(x)", OF_ONE(mpfr_atanh), 2, 5, 5, Unit},
    {"atanpi", "atanpi(x)", OF_ONE_IN_HALF_TURNS(mpfr_atanu), 2, 5, 5},
    {"cbrt", "cbrt(x)", OF_ONE(mpfr_cbrt), 2, 2, 2},
    {"ceil", "ceil(x)", TO_WHOLE(mpfr_ceil), 0.5, 0.5, 0.5},
    {"ceil", "ceil(x)", TO_WHOLE(mpfr_ceil), 0.5, 0.5, 0.5, Moderate},
    {"cos", "cos(x)", OF_ONE(mpfr_cos), 2, 4, 4},
    {"cos", "cos(x)", OF_ONE(mpfr_cos), 2, 4, 4, Moderate},
    {"cosh", "cosh(x)", OF_ONE(mpfr_cosh), 2, 4, 4},
    {"cosh", "cosh(x)", OF_ONE(mpfr_cosh), 2, 4, 4, Moderate},
    {"cospi", "cospi(x)", OF_ONE_IN_HALF_TURNS(mpfr_cosu), 2, 4, 4},
    {"cospi", "cospi(x)", OF_ONE_IN_HALF_TURNS(mpfr_cosu), 2, 4, 4, Moderate},
    {"degrees", "degrees(x)", degrees, 2, 2, 2},
    {"erf", "erf(x)", OF_ONE(mpfr_erf), 4, 16, 16},
    {"erf", "erf(x)", OF_ONE(mpfr_erf), 4, 16, 16, Moderate},
    {"erfc", "erfc(x)", OF_ONE(mpfr_erfc), 4, 16, 16},
    {"erfc", "erfc(x)", OF_ONE(mpfr_erfc), 4, 16, 16, Moderate},
    {"exp", "exp(x)", OF_ONE(mpfr_exp), 2, 3, 3},
    {"exp", "exp(x)", OF_ONE(mpfr_exp), 2, 3, 3, Moderate},
    {"exp10", "exp10(x)", OF_ONE(mpfr_exp10), 2, 3, 3},
    {"exp10", "exp10(x)", OF_ONE(mpfr_exp10), 2, 3, 3, Moderate},
    {"exp2", "exp2(x)", OF_ONE(mpfr_exp2), 2, 3, 3},
    {"exp2", "exp2(x)", OF_ONE(mpfr_exp2), 2, 3, 3, Moderate},
    {"expm1", "expm1(x)", OF_ONE(mpfr_expm1), 2, 3, 3},
    {"expm1", "expm1(x)", OF_ONE(mpfr_expm1), 2, 3, 3, Moderate},
    {"fabs", "fabs(x)", OF_ONE(mpfr_abs), 0.5, 0.5, 0.5},
    {"fdim", "fdim(x, y)", OF_TWO(mpfr_dim), 0.5, 0.5, 0.5},
    {"fdim", "fdim(x, y)", OF_TWO(mpfr_dim), 0.5, 0.5, 0.5, Moderate, Moderate},
    {"floor", "floor(x)", TO_WHOLE(mpfr_floor), 0.5, 0.5, 0.5},
    {"floor", "floor(x)", TO_WHOLE(mpfr_floor), 0.5, 0.5, 0.5, Moderate},
    {"fma", "fma(x, y, z)", fma, 0.5, 0.5, 0.5},
    {"fma", "fma(x, y, z)", fma, 0.5, 0.5, 0.5, Moderate, Moderate},
    {"fmax", "fmax(x, y) + REAL(0)", maximum, 0.5, 0.5, 0.5},
    {"fmin", "fmin(x, y) + REAL(0)", minimum, 0.5, 0.5, 0.5},
    {"fmod", "fmod(x, y)", OF_TWO(mpfr_fmod), 0.5, 0.5, 0.5},
    {"fmod", "fmod(x, y)", OF_TWO(mpfr_fmod), 0.5, 0.5, 0.5, Moderate,
     Moderate},
    {"hypot", "hypot(x, y)", OF_TWO(mpfr_hypot), 2, 4, 4},
    {"hypot", "hypot(x, y)", OF_TWO(mpfr_hypot), 2, 4, 4, Moderate, Moderate},
    {"ldexp", "ldexp(x, WHOLE(y))", ldexp, 0.5, 0.5, 0.5, Any, SmallInts},
    {"lgamma", "lgamma(x)", lgamma, None, None, None, Moderate},
    {"log", "log(x)", OF_ONE(mpfr_log), 2, 3, 3},
    {"log", "log(x)", OF_ONE(mpfr_log), 2, 3, 3, NearOne},
    {"log10", "log10(x)", OF_ONE(mpfr_log10), 2, 3, 3},
    {"log10", "log10(x)", OF_ONE(mpfr_log10), 2, 3, 3, NearOne},
    {"log1p", "log1p(x)", OF_ONE(mpfr_log1p), 2, 2, 2},
    {"log1p", "log1p(x)", OF_ONE(mpfr_log1p), 2, 2, 2, Unit},
    {"log2", "log2(x)", OF_ONE(mpfr_log2), 2, 3, 3},
    {"log2", "log2(x)", OF_ONE(mpfr_log2), 2, 3, 3, NearOne},
    {"logb", "logb(x)", logb, 0.5, 0.5, 0.5},
    {"modf", "modf(x, &ignored)", fraction, 0.5, 0.5, 0.5},
    {"modf", "modf(x, &ignored)", fraction, 0.5, 0.5, 0.5, Moderate},
    {"pow", "pow(x, y)", OF_TWO(mpfr_pow), 4, 16, 16},
    {"pow", "pow(x, y)", OF_TWO(mpfr_pow), 4, 16, 16, Positive, Moderate},
    {"pow", "pow(x, y)", OF_TWO(mpfr_pow), 4, 16, 16, Moderate, Moderate},
    {"pown", "pown(x, WHOLE(y))", pown, 4, 16, 16, Any, SmallInts},
    {"pown", "pown(x, WHOLE(y))", pown, 4, 16, 16, Moderate, SmallInts},
    {"powr", "powr(x, y)", OF_TWO(mpfr_pow), 4, 16, 16, Positive, Moderate},
    {"radians", "radians(x)", radians, 2, 2, 2},
    {"remainder", "remainder(x, y)", OF_TWO(mpfr_remainder), 0.5, 0.5, 0.5},
    {"remainder", "remainder(x, y)", OF_TWO(mpfr_remainder), 0.5, 0.5, 0.5,
     Moderate, Moderate},
    {"rint", "rint(x)", TO_WHOLE(mpfr_roundeven), 0.5, 0.5, 0.5},
    {"rint", "rint(x)", TO_WHOLE(mpfr_roundeven), 0.5, 0.5, 0.5, Moderate},
    {"rootn", "rootn(x, WHOLE(y))", rootn, 4, 16, 16, Any, SmallInts},
    {"rootn", "rootn(x, WHOLE(y))", rootn, 4, 16, 16, Moderate, SmallInts},
    {"round", "round(x)", TO_WHOLE(mpfr_round), 0.5, 0.5, 0.5},
    {"round", "round(x)", TO_WHOLE(mpfr_round), 0.5, 0.5, 0.5, Moderate},
    {"rsqrt", "rsqrt(x)", OF_ONE(mpfr_rec_sqrt), 1, 2, 2, Positive},
    {"sin", "sin(x)", OF_ONE(mpfr_sin), 2, 4, 4},
    {"sin", "sin(x)", OF_ONE(mpfr_sin), 2, 4, 4, Moderate},
    {"sincos", "sincos(x, &ignored)", OF_ONE(mpfr_sin), 2, 4, 4},
    {"sincos", "(sincos(x, &ignored), ignored)", OF_ONE(mpfr_cos), 2, 4, 4},
    {"sinh", "sinh(x)", OF_ONE(mpfr_sinh), 2, 4, 4},
    {"sinh", "sinh(x)", OF_ONE(mpfr_sinh), 2, 4, 4, Moderate},
    {"sinpi", "sinpi(x)", OF_ONE_IN_HALF_TURNS(mpfr_sinu), 2, 4, 4},
    {"sinpi", "sinpi(x)", OF_ONE_IN_HALF_TURNS(mpfr_sinu), 2, 4, 4, Moderate},
    {"sqrt", "sqrt(x)", OF_ONE(mpfr_sqrt), 0.5, 3, 0.5},
    {"sqrt", "sqrt(x)", OF_ONE(mpfr_sqrt), 0.5, 3, 0.5, Positive},
    {"tan", "tan(x)", OF_ONE(mpfr_tan), 2, 5, 5},
    {"tan", "tan(x)", OF_ONE(mpfr_tan), 2, 5, 5, Moderate},
    {"tanh", "tanh(x)", OF_ONE(mpfr_tanh), 2, 5, 5},
    {"tanh", "tanh(x)", OF_ONE(mpfr_tanh), 2, 5, 5, Moderate},
    {"tanpi", "tanpi(x)", OF_ONE_IN_HALF_TURNS(mpfr_tanu), 2, 6, 6},
    {"tanpi", "tanpi(x)", OF_ONE_IN_HALF_TURNS(mpfr_tanu), 2, 6, 6, Moderate},
    {"tgamma", "tgamma(x)", OF_ONE(mpfr_gamma), 4, 16, 16, Moderate},
    {"trunc", "trunc(x)", TO_WHOLE(mpfr_trunc), 0.5, 0.5, 0.5},
    {"trunc", "trunc(x)", TO_WHOLE(mpfr_trunc), 0.5, 0.5, 0.5, Moderate},
};

/// half_ functions have limits where angles are below 2^16.
const MathFunction FloatFunctions[] = {
    {"half_cos", "half_cos(x)", OF_ONE(mpfr_cos), None, 8192, None, Moderate},
    {"half_divide", "half_divide(x, y)", OF_TWO(mpfr_div), None, 8192, None,
     Moderate, Moderate},
    {"half_exp", "half_exp(x)", OF_ONE(mpfr_exp), None, 8192, None, Moderate},
    {"half_exp10", "half_exp10(x)", OF_ONE(mpfr_exp10), None, 8192, None,
     Moderate},
    {"half_exp2", "half_exp2(x)", OF_ONE(mpfr_exp2), None, 8192, None,
     Moderate},
    {"half_log", "half_log(x)", OF_ONE(mpfr_log), None, 8192, None, Positive},
    {"half_log10", "half_log10(x)", OF_ONE(mpfr_log10), None, 8192, None,
     Positive},
    {"half_log2", "half_log2(x)", OF_ONE(mpfr_log2), None, 8192, None,
     Positive},
    {"half_powr", "half_powr(x, y)", OF_TWO(mpfr_pow), None, 8192, None,
     Positive, Moderate},
    {"half_recip", "half_recip(x)", reciprocal, None, 8192, None, Moderate},
    {"half_rsqrt", "half_rsqrt(x)", OF_ONE(mpfr_rec_sqrt), None, 8192, None,
     Positive},
    {"half_sin", "half_sin(x)", OF_ONE(mpfr_sin), None, 8192, None, Moderate},
    {"half_sqrt", "half_sqrt(x)", OF_ONE(mpfr_sqrt), None, 8192, None,
     Positive},
    {"half_tan", "half_tan(x)", OF_ONE(mpfr_tan), None, 8192, None, Moderate},
    {"native_cos", "native_cos(x)", OF_ONE(mpfr_cos), None, None, None,
     Moderate},
    {"native_divide", "native_divide(x, y)", OF_TWO(mpfr_div), None, None, None,
     Moderate, Moderate},
    {"native_exp", "native_exp(x)", OF_ONE(mpfr_exp), None, None, None,
     Moderate},
    {"native_exp10", "native_exp10(x)", OF_ONE(mpfr_exp10), None, None, None,
     Moderate},
    {"native_exp2", "native_exp2(x)", OF_ONE(mpfr_exp2), None, None, None,
     Moderate},
    {"native_log", "native_log(x)", OF_ONE(mpfr_log), None, None, None,
     Positive},
    {"native_log10", "native_log10(x)", OF_ONE(mpfr_log10), None, None, None,
     Positive},
    {"native_log2", "native_log2(x)", OF_ONE(mpfr_log2), None, None, None,
     Positive},
    {"native_powr", "native_powr(x, y)", OF_TWO(mpfr_pow), None, None, None,
     Positive, Moderate},
    {"native_recip", "native_recip(x)", reciprocal, None, None, None, Moderate},
    {"native_rsqrt", "native_rsqrt(x)", OF_ONE(mpfr_rec_sqrt), None, None, None,
     Positive},
    {"native_sin", "native_sin(x)", OF_ONE(mpfr_sin), None, None, None,
     Moderate},
    {"native_sqrt", "native_sqrt(x)", OF_ONE(mpfr_sqrt), None, None, None,
     Positive},
    {"native_tan", "native_tan(x)", OF_ONE(mpfr_tan), None, None, None,
     Moderate},
};

} // namespace

std::span<const MathFunction> mathFunctions() { return Functions; }
std::span<const MathFunction> floatFunctions() { return FloatFunctions; }

} // namespace vorion::test
