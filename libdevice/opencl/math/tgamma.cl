/* tgamma(x). SLEEF's is good to 1 ulp but where results are subnormal: below
   -30 it lost up to 125 ulp, because a factor before the last is subnormal
   there, too. */

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

float2 _CL_OVERLOADABLE tgamma(float2 x) {
  return (float2)(tgamma(x.lo), tgamma(x.hi));
}

float3 _CL_OVERLOADABLE tgamma(float3 x) {
  return (float3)(tgamma(x.lo), tgamma(x.z));
}

float4 _CL_OVERLOADABLE tgamma(float4 x) {
  return (float4)(tgamma(x.lo), tgamma(x.hi));
}

float8 _CL_OVERLOADABLE tgamma(float8 x) {
  return (float8)(tgamma(x.lo), tgamma(x.hi));
}

float16 _CL_OVERLOADABLE tgamma(float16 x) {
  return (float16)(tgamma(x.lo), tgamma(x.hi));
}
