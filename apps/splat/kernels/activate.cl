// From stored parameters to activated ones, each rounded once: exp, logistic
// function and normalisation are carried as unevaluated sums (high, low) of two
// floats, good to about 2^-40, so that the device, the host and the reference
// start from the same fp32 bits (T. J. Dekker 1971, "A floating-point technique
// for extending the available precision").

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

static pair4 square_pair4(pair4 a) {
  const float4 high = a.high * a.high;
  const float4 low = fma(a.high, a.high, -high) + 2.0f * a.high * a.low;
  return fast_two_sum4(high, low);
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
// Beyond these the result is infinite or 0, or the opacity 0 or 1, anyway.
#define MOST_SCALE 150.0f
#define MOST_LOGIT 80.0f

// e^x = (high + low) 2^power for |x| <= 150.
static pair4 exp_pair4(float4 x, int4 *power) {
  *power = convert_int4_rte(x * 1.44269504f);
  const float4 n = convert_float4(*power);
  const float4 exact = fma(-n, (float4)LN2_HIGH, x);
  const float4 product = n * LN2_MIDDLE;
  const float4 product_low = fma(n, (float4)LN2_MIDDLE, -product);
  pair4 r = two_sum4(exact, -product);
  r = fast_two_sum4(r.high, r.low - product_low - n * LN2_LOW);

  // e^r - 1 from e^(r/64) - 1 = t + t^2/2 + t^3/6 + ..., of which only the
  // first two terms need both floats, and six times s -> 2 s + s^2. All of
  // these are under 1, so that the larger summand is known.
  const pair4 t = {r.high * 0.015625f, r.low * 0.015625f};
  pair4 half_square = square_pair4(t);
  half_square.high *= 0.5f;
  half_square.low *= 0.5f;
  const float4 rest =
      t.high * t.high * t.high *
      (1.0f / 6.0f + t.high * (1.0f / 24.0f + t.high * (1.0f / 120.0f)));
  pair4 s = fast_two_sum4(t.high, half_square.high);
  s = fast_two_sum4(s.high, s.low + (t.low + half_square.low + rest));
  for (int i = 0; i < 6; ++i) {
    const pair4 square = square_pair4(s);
    const pair4 sum = fast_two_sum4(2.0f * s.high, square.high);
    s = fast_two_sum4(sum.high, sum.low + (2.0f * s.low + square.low));
  }
  const pair4 one = fast_two_sum4((float4)1.0f, s.high);
  return fast_two_sum4(one.high, one.low + s.low);
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
