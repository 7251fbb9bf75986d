// Lines that lose digits, between lines that do not.
kernel void bad(global const float *in, global float *out) {
  uint i = get_global_id(0);
  float x = in[i];
  float good = fma(x, x, 1.0f) / 3.0f;
  float lost = (x + 1e7f) - 1e7f;
  float after = lost * 0.5f + good;
  out[i] = after;
}

// The variance of 16 numbers, as it should not be computed and as it should.
kernel void variance(global const float *in, global float *out) {
  uint i = get_global_id(0);
  float sum = 0, squares = 0;
  for (uint k = 0; k < 16; ++k) {
    float x = in[16 * i + k] + 1000.0f;
    sum += x;
    squares += x * x;
  }
  float mean = sum / 16;
  float naive = squares / 16 - mean * mean;
  float spread = 0;
  for (uint k = 0; k < 16; ++k) {
    float off = in[16 * i + k] + 1000.0f - mean;
    spread += off * off;
  }
  out[2 * i] = naive;
  out[2 * i + 1] = spread / 16;
}

// A division by what should not be zero.
kernel void zero(global const float *in, global float *out) {
  uint i = get_global_id(0);
  float x = in[i];
  float none = x - in[i];
  float inverse = 1.0f / none;
  float nan = inverse * none;
  out[i] = nan + 1.0f;
}

// A decision on digits that are gone.
kernel void decide(global const float *in, global float *out) {
  uint i = get_global_id(0);
  float x = in[i] * 1e-9f;
  float one = x + 1.0f;
  if (one > 1.0f)
    out[i] = in[i];
  else
    out[i + 16] = 1.0f;
}
