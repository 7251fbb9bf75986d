// From stored parameters to activated ones, each rounded once: exp, logistic
// function and normalisation are carried as unevaluated sums (high, low) of two
// floats, good to about 2^-40, so that the device, the host and the reference
// start from the same fp32 bits (T. J. Dekker 1971, "A floating-point technique
// for extending the available precision").
#pragma once

static float2 two_sum(float a, float b) {
  const float sum = a + b;
  const float shadow = sum - a;
  return (float2)(sum, (a - (sum - shadow)) + (b - shadow));
}

// Needs |a| >= |b| or a == 0.
static float2 fast_two_sum(float a, float b) {
  const float sum = a + b;
  return (float2)(sum, b - (sum - a));
}

// Four numbers at once, as an unevaluated sum each. A core waits for the result
// of an operation, so four chains take little more time than one.
typedef struct {
  float4 high, low;
} pair4;

static pair4 two_sum4(float4 a, float4 b) {
  const float4 sum = a + b;
  const float4 shadow = sum - a;
  return (pair4){sum, (a - (sum - shadow)) + (b - shadow)};
}

// Needs |a| >= |b| or a == 0 everywhere; then two_sum4's very bits.
static pair4 fast_two_sum4(float4 a, float4 b) {
  const float4 sum = a + b;
  return (pair4){sum, b - (sum - a)};
}

// a 2^n without intermediate overflow for |n| <= 252.
static float scale_by_power(float a, int n) {
  const int half_n = n / 2;
  return a * as_float((half_n + 127) << 23) *
         as_float((n - half_n + 127) << 23);
}

// ln 2 in three parts; the first has 9 bits, so that n times it is exact.
#define LN2_HIGH 0x1.62p-1f
#define LN2_MIDDLE 0x1.c85fep-10f
#define LN2_LOW -0x1.718432p-35f
// 1/4! and 1/5!, each in two parts. 1/3! has four times those of 1/4!.
#define TERM_4 0x1.555556p-5f
#define TERM_4_LOW -0x1.555556p-30f
#define TERM_5 0x1.111112p-7f
#define TERM_5_LOW -0x1.dddddep-32f
// Beyond these the result is infinite or 0, or the opacity 0 or 1, anyway.
#define MOST_SCALE 150.0f
#define MOST_LOGIT 80.0f

// c + t a, where |t a| < c and `low` is what a float c has lost.
static pair4 horner_step(pair4 t, pair4 a, float c, float low) {
  const float4 product = t.high * a.high;
  float4 rest = fma(t.high, a.high, -product);
  rest = fma(t.high, a.low, rest);
  rest = fma(t.low, a.high, rest);
  const pair4 sum = fast_two_sum4((float4)c, product);
  return (pair4){sum.high, sum.low + (rest + low)};
}

// e^x = (high + low) 2^power for |x| <= 150.
static pair4 exp_pair4(float4 x, int4 *power) {
  *power = convert_int4_rte(x * 1.44269504f);
  const float4 n = convert_float4(*power);
  const float4 exact = fma(-n, (float4)LN2_HIGH, x);
  const float4 product = n * LN2_MIDDLE;
  const float4 product_low = fma(n, (float4)LN2_MIDDLE, -product);
  pair4 t = two_sum4(exact, -product);
  t = fast_two_sum4(t.high, t.low - product_low - n * LN2_LOW);

  // Taylor's series, which |t| <= ln 2 / 2 makes short. Floats are exact enough
  // for the terms from t^6 on. The last one, of t^11, is 2^-42 at most.
  float4 tail = (float4)(1.0f / 39916800.0f);
  tail = fma(tail, t.high, (float4)(1.0f / 3628800.0f));
  tail = fma(tail, t.high, (float4)(1.0f / 362880.0f));
  tail = fma(tail, t.high, (float4)(1.0f / 40320.0f));
  tail = fma(tail, t.high, (float4)(1.0f / 5040.0f));
  tail = fma(tail, t.high, (float4)(1.0f / 720.0f));
  pair4 e = fast_two_sum4((float4)TERM_5, t.high * tail);
  e.low += TERM_5_LOW;
  // The terms of t^4 and t^3, then of t^2, t and 1: as loops, so that what one
  // step needs is in registers.
  float c = TERM_4, low = TERM_4_LOW;
#pragma unroll 1
  for (int i = 0; i < 2; ++i, c *= 4.0f, low *= 4.0f)
    e = horner_step(t, e, c, low);
  c = 0.5f;
#pragma unroll 1
  for (int i = 0; i < 3; ++i, c = fmin(c + c, 1.0f))
    e = horner_step(t, e, c, 0.0f);
  return fast_two_sum4(e.high, e.low);
}

// From (log scales x, y, z; logit of the opacity) to scales and opacity.
static float4 activate_scales_and_opacity(float4 stored) {
  const float4 limit = (float4)(MOST_SCALE, MOST_SCALE, MOST_SCALE, MOST_LOGIT);
  const float4 x = (float4)(stored.x, stored.y, stored.z, -stored.w);
  int4 power;
  const pair4 e = exp_pair4(clamp(x, -limit, limit), &power);
  const float high = scale_by_power(e.high.w, power.w);
  const float low = scale_by_power(e.low.w, power.w);
  const float2 sum = two_sum(1.0f, high);
  const float2 d = fast_two_sum(sum.x, sum.y + low);
  const float q = 1.0f / d.x;
  return (float4)(scale_by_power(e.high.x, power.x),
                  scale_by_power(e.high.y, power.y),
                  scale_by_power(e.high.z, power.z),
                  q + q * (fma(-q, d.x, 1.0f) - q * d.y));
}

// A power of two that brings a quaternion to where squares stay in fp32's range.
static float quaternion_factor(float4 q) {
  const float largest =
      fmax(fmax(fabs(q.x), fabs(q.y)), fmax(fabs(q.z), fabs(q.w)));
  return largest < 0x1p-50f ? 0x1p110f : largest > 0x1p60f ? 0x1p-66f : 1.0f;
}

// Unit length; a zero quaternion stays zero, which turns nothing.
static float4 activate_quaternion(float4 q) {
  q *= quaternion_factor(q);
  const float part[4] = {q.x, q.y, q.z, q.w};
  const float first = part[0] * part[0];
  float2 squares = (float2)(first, fma(part[0], part[0], -first));
#pragma unroll
  for (int k = 1; k < 4; ++k) {
    const float high = part[k] * part[k];
    const float2 sum = two_sum(squares.x, high);
    squares =
        fast_two_sum(sum.x, sum.y + (squares.y + fma(part[k], part[k], -high)));
  }
  if (!(squares.x > 0.0f))
    return (float4)(0.0f, 0.0f, 0.0f, 0.0f);
  const float norm = sqrt(squares.x);
  const float norm_low =
      (fma(-norm, norm, squares.x) + squares.y) / (2.0f * norm);
  float unit[4];
#pragma unroll
  for (int k = 0; k < 4; ++k) {
    const float quotient = part[k] / norm;
    const float rest = fma(-quotient, norm, part[k]) - quotient * norm_low;
    unit[k] = quotient + rest / norm;
  }
  return (float4)(unit[0], unit[1], unit[2], unit[3]);
}
