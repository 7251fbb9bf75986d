// The loss of a picture against a photograph and its gradient: 0.8 of the mean
// absolute difference and 0.2 of 1 - SSIM (Wang et al. 2004, "Image quality
// assessment"), whose window is a Gaussian of 11x11 pixels with sigma 1.5,
// zero outside the picture. The window is separable: every quantity is summed
// along rows, then along columns, and the gradient goes back the same way, as
// the window is its own adjoint. reference/Loss.h is the same in fp64.
//
// Per channel there are MOMENTS sums: of x, y, x^2, y^2, x y over the window,
// x the picture and y the photograph; of these, x, x^2 and x y depend on the
// picture. Plane p of pixel i is at p * pixels + i. Beyond the picture a weight
// is 0 rather than left out, and loops are unrolled: lanes stay together, and
// the sums in registers.

#define REACH 5
#define MOMENTS 5
#define SLOPES 3

__constant float window[REACH + 1] = {0.2660117248617943f,   0.21300553771125366f,
                                      0.1093606895097f,      0.03600077212843082f,
                                      0.007598758135239184f, 0.0010283800844791099f};

// A place of the window that lies on pixel i: its weight, and what to read.
typedef struct {
  float weight;
  uint at;
} tap;

// `d` pixels after pixel i, which stands at `place` of a line of `length` whose
// pixels are `step` apart. Places before 0 wrap to large ones, so that one
// comparison finds both ends, without a branch.
static tap window_tap(uint i, uint place, int d, uint length, uint step) {
  const bool inside = place + d < length;
  const tap t = {inside ? window[abs(d)] : 0.0f, inside ? i + d * step : i};
  return t;
}

// SSIM's constants for values from 0 to 1.
#define C1 1e-4f
#define C2 9e-4f

// Channel c of a photograph's pixel, 0 to 1.
static float photo_value(uint packed, uint c) {
  return (float)(packed >> 8 * c & 0xff) / 255.0f;
}

static float channel(float4 p, uint c) {
  return c == 0 ? p.x : c == 1 ? p.y : p.z;
}

__kernel void loss_rows(__global const float4 *picture,
                        __global const uint *photo, __global float *moments,
                        uint width, uint height) {
  const uint i = get_global_id(0);
  const uint pixels = width * height;
  if (i >= pixels)
    return;
  const uint column = i % width;
  float sums[3 * MOMENTS];
  for (uint k = 0; k < 3 * MOMENTS; ++k)
    sums[k] = 0.0f;
#pragma unroll
  for (int d = -REACH; d <= REACH; ++d) {
    const tap t = window_tap(i, column, d, width, 1);
    const float4 x4 = picture[t.at];
    const uint packed = photo[t.at];
#pragma unroll
    for (uint c = 0; c < 3; ++c) {
      const float x = channel(x4, c), y = photo_value(packed, c);
      const float wx = t.weight * x, wy = t.weight * y;
      sums[MOMENTS * c] += wx;
      sums[MOMENTS * c + 1] += wy;
      sums[MOMENTS * c + 2] = fma(wx, x, sums[MOMENTS * c + 2]);
      sums[MOMENTS * c + 3] = fma(wy, y, sums[MOMENTS * c + 3]);
      sums[MOMENTS * c + 4] = fma(wx, y, sums[MOMENTS * c + 4]);
    }
  }
  for (uint k = 0; k < 3 * MOMENTS; ++k)
    moments[k * pixels + i] = sums[k];
}

// The window along the column of pixel i, of one plane.
static float column_sum(__global const float *plane, uint i, uint row,
                        uint width, uint height) {
  float sum = 0.0f;
#pragma unroll
  for (int d = -REACH; d <= REACH; ++d) {
    const tap t = window_tap(i, row, d, height, width);
    sum = fma(t.weight, plane[t.at], sum);
  }
  return sum;
}

// SSIM of every pixel and channel, and its slopes by the sums of x, x^2 and
// x y. `terms` gets a pixel's sums over channels of |x - y| and SSIM.
__kernel void loss_columns(__global const float4 *picture,
                           __global const uint *photo,
                           __global const float *moments,
                           __global float *slopes, __global float2 *terms,
                           uint width, uint height) {
  const uint i = get_global_id(0);
  const uint pixels = width * height;
  if (i >= pixels)
    return;
  const uint row = i / width;
  const float4 x4 = picture[i];
  const uint packed = photo[i];
  float2 sum = (float2)(0.0f, 0.0f);
#pragma unroll
  for (uint c = 0; c < 3; ++c) {
    float m[MOMENTS];
#pragma unroll
    for (uint k = 0; k < MOMENTS; ++k)
      m[k] = column_sum(moments + (MOMENTS * c + k) * pixels, i, row, width,
                        height);
    const float mean_x = m[0], mean_y = m[1];
    const float variance_x = fma(-mean_x, mean_x, m[2]);
    const float variance_y = fma(-mean_y, mean_y, m[3]);
    const float covariance = fma(-mean_x, mean_y, m[4]);
    const float a = 2.0f * mean_x * mean_y + C1;
    const float b = 2.0f * covariance + C2;
    const float p = mean_x * mean_x + mean_y * mean_y + C1;
    const float q = variance_x + variance_y + C2;
    const float inverse = 1.0f / (p * q);
    const float ssim = a * b * inverse;
    // Of ssim = a b / (p q), with the variances' own dependence on the mean.
    const float by_mean =
        2.0f * (mean_y * (b - a) * inverse + mean_x * ssim * (1.0f / q - 1.0f / p));
    slopes[(SLOPES * c) * pixels + i] = by_mean;
    slopes[(SLOPES * c + 1) * pixels + i] = -ssim / q;
    slopes[(SLOPES * c + 2) * pixels + i] = 2.0f * a * inverse;
    sum.x += fabs(channel(x4, c) - photo_value(packed, c));
    sum.y += ssim;
  }
  terms[i] = sum;
}

__kernel void loss_spread(__global const float *slopes, __global float *spread,
                          uint width, uint height) {
  const uint i = get_global_id(0);
  const uint pixels = width * height;
  if (i >= pixels)
    return;
  const uint column = i % width;
  float sums[3 * SLOPES];
  for (uint k = 0; k < 3 * SLOPES; ++k)
    sums[k] = 0.0f;
#pragma unroll
  for (int d = -REACH; d <= REACH; ++d) {
    const tap t = window_tap(i, column, d, width, 1);
#pragma unroll
    for (uint k = 0; k < 3 * SLOPES; ++k)
      sums[k] = fma(t.weight, slopes[k * pixels + t.at], sums[k]);
  }
  for (uint k = 0; k < 3 * SLOPES; ++k)
    spread[k * pixels + i] = sums[k];
}

// dL/d(picture): `per_absolute` and `per_ssim` are the shares of one pixel's
// channel in the loss. The sign of 0 is 0. Three floats a pixel.
__kernel void loss_gradient(__global const float4 *picture,
                            __global const uint *photo,
                            __global const float *spread,
                            __global float *gradient, uint width, uint height,
                            float per_absolute, float per_ssim) {
  const uint i = get_global_id(0);
  const uint pixels = width * height;
  if (i >= pixels)
    return;
  const uint row = i / width;
  const float4 x4 = picture[i];
  const uint packed = photo[i];
  for (uint c = 0; c < 3; ++c) {
    const float x = channel(x4, c), y = photo_value(packed, c);
    float s[SLOPES];
    for (uint k = 0; k < SLOPES; ++k)
      s[k] = column_sum(spread + (SLOPES * c + k) * pixels, i, row, width,
                        height);
    const float ssim = s[0] + 2.0f * x * s[1] + y * s[2];
    const float side = x > y ? 1.0f : x < y ? -1.0f : 0.0f;
    gradient[3 * i + c] = per_absolute * side - per_ssim * ssim;
  }
}

// Sums of `terms` over each row, so that the host adds few numbers.
__kernel void loss_sum(__global const float2 *terms, __global float2 *rows,
                       uint width, uint height) {
  const uint row = get_global_id(0);
  if (row >= height)
    return;
  float2 sum = (float2)(0.0f, 0.0f);
  for (uint x = 0; x < width; ++x)
    sum += terms[row * width + x];
  rows[row] = sum;
}
