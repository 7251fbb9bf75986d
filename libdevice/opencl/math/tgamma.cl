/* tgamma(x). SLEEF's is good to 1 ulp but where results are subnormal: below
   -30 the float's lost up to 125 ulp, because a factor before the last is
   subnormal there, too. */

float Sleef_tgammaf_u10(float x);

float _CL_OVERLOADABLE tgamma(float x) {
  if (!(x < -30.0f && x > -60.0f))
    return Sleef_tgammaf_u10(x);
  /* gamma(x) = gamma(x + 8) / (x (x + 1) ... (x + 7)). The sums are exact, and
     each product and the quotient round once: 7 ulp at most in tests. */
  float product = x;
  for (int i = 1; i < 8; ++i)
    product *= x + (float)i;
  return Sleef_tgammaf_u10(x + 8.0f) / product;
}

__IF_FP64(
double Sleef_tgamma_u10(double x);

double _CL_OVERLOADABLE tgamma(double x) { return Sleef_tgamma_u10(x); }
)

#define TGAMMA_OF_VECTOR(vector, low, high)                                    \
  vector _CL_OVERLOADABLE tgamma(vector x) {                                   \
    return (vector)(tgamma(x.low), tgamma(x.high));                            \
  }
#define TGAMMA_OF_VECTORS(type)                                                \
  TGAMMA_OF_VECTOR(type##2, lo, hi)                                            \
  TGAMMA_OF_VECTOR(type##3, lo, z)                                             \
  TGAMMA_OF_VECTOR(type##4, lo, hi)                                            \
  TGAMMA_OF_VECTOR(type##8, lo, hi)                                            \
  TGAMMA_OF_VECTOR(type##16, lo, hi)

TGAMMA_OF_VECTORS(float)
__IF_FP64(TGAMMA_OF_VECTORS(double))
