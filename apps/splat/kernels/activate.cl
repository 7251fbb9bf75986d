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

static float2 square_pair(float2 a) {
  const float high = a.x * a.x;
  const float low = fma(a.x, a.x, -high) + 2.0f * a.x * a.y;
  return fast_two_sum(high, low);
}

// a 2^n without intermediate overflow for |n| <= 252.
static float scale_by_power(float a, int n) {
  const int half_n = n / 2;
  return a * as_float((half_n + 127) << 23) *
         as_float((n - half_n + 127) << 23);
}

// e^x = (high + low) 2^power for |x| <= 150.
static float2 exp_pair(float x, int *power) {
  // ln 2 in three parts; the first has 9 bits, so that n times it is exact.
  const float ln2_high = 0x1.62p-1f;
  const float ln2_middle = 0x1.c85fep-10f;
  const float ln2_low = -0x1.718432p-35f;
  const float n = rint(x * 1.44269504f);
  const float exact = fma(-n, ln2_high, x);
  const float product = n * ln2_middle;
  const float product_low = fma(n, ln2_middle, -product);
  float2 r = two_sum(exact, -product);
  r = fast_two_sum(r.x, r.y - product_low - n * ln2_low);

  // e^r - 1 from e^(r/64) - 1 = t + t^2/2 + t^3/6 + ..., of which only the
  // first two terms need both floats, and six times s -> 2 s + s^2.
  const float2 t = r * 0.015625f;
  const float2 half_square = square_pair(t) * 0.5f;
  const float rest =
      t.x * t.x * t.x * (0.16666667f + t.x * (0.041666668f + t.x * 0.008333334f));
  float2 s = two_sum(t.x, half_square.x);
  s = fast_two_sum(s.x, s.y + (t.y + half_square.y + rest));
  for (int i = 0; i < 6; ++i) {
    const float2 square = square_pair(s);
    const float2 sum = two_sum(2.0f * s.x, square.x);
    s = fast_two_sum(sum.x, sum.y + (2.0f * s.y + square.y));
  }
  *power = (int)n;
  const float2 one = fast_two_sum(1.0f, s.x);
  return fast_two_sum(one.x, one.y + s.y);
}

static float activate_scale(float log_scale) {
  int power;
  // Beyond these the result is infinite or 0 anyway.
  const float2 e = exp_pair(clamp(log_scale, -150.0f, 150.0f), &power);
  return scale_by_power(e.x, power);
}

static float activate_opacity(float logit) {
  int power;
  const float2 e = exp_pair(clamp(-logit, -80.0f, 80.0f), &power);
  const float high = scale_by_power(e.x, power);
  const float low = scale_by_power(e.y, power);
  const float2 sum = two_sum(1.0f, high);
  const float2 d = fast_two_sum(sum.x, sum.y + low);
  const float q = 1.0f / d.x;
  return q + q * (fma(-q, d.x, 1.0f) - q * d.y);
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
  float2 squares = (float2)(0.0f, 0.0f);
  for (int k = 0; k < 4; ++k) {
    const float high = part[k] * part[k];
    const float2 sum = two_sum(squares.x, high);
    squares = fast_two_sum(
        sum.x, sum.y + (squares.y + fma(part[k], part[k], -high)));
  }
  if (!(squares.x > 0.0f))
    return (float4)(0.0f, 0.0f, 0.0f, 0.0f);
  const float norm = sqrt(squares.x);
  const float norm_low =
      (fma(-norm, norm, squares.x) + squares.y) / (2.0f * norm);
  float unit[4];
  for (int k = 0; k < 4; ++k) {
    const float quotient = part[k] / norm;
    const float rest = fma(-quotient, norm, part[k]) - quotient * norm_low;
    unit[k] = quotient + rest / norm;
  }
  return (float4)(unit[0], unit[1], unit[2], unit[3]);
}
