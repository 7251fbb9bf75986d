// A picture as a camera of another exposure has it: a matrix of 3 rows and 4
// columns takes (red, green, blue, 1) to the three channels.

#define LANES 16
#define TERMS 12

__kernel void exposure_apply(__global const float4 *picture,
                             __global float4 *exposed,
                             __constant const float *matrix, uint pixels) {
  const uint i = get_global_id(0);
  if (i >= pixels)
    return;
  const float4 p = picture[i];
  float to[3];
  for (uint c = 0; c < 3; ++c) {
    __constant const float *row = matrix + 4 * c;
    to[c] = row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
  }
  exposed[i] = (float4)(to[0], to[1], to[2], p.w);
}

// The way back: `gradient`, three floats a pixel, is that by the exposed
// picture and becomes that by the picture. `sums` gets that by the matrix, of
// each group's `stretch` pixels, added up in a fixed order.
__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
exposure_back(__global const float4 *picture, __global float *gradient,
              __constant const float *matrix, __global float *sums,
              uint pixels, uint stretch) {
  __local float parts[TERMS][LANES];
  const uint lane = get_local_id(0);
  const uint first = get_group_id(0) * stretch;
  const uint end = min(first + stretch, pixels);
  float sum[TERMS] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f,
                      0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  for (uint i = first + lane; i < end; i += LANES) {
    const float4 p = picture[i];
    const float from[4] = {p.x, p.y, p.z, 1.0f};
    const float g[3] = {gradient[3 * i], gradient[3 * i + 1],
                        gradient[3 * i + 2]};
    for (uint c = 0; c < 3; ++c)
      for (uint k = 0; k < 4; ++k)
        sum[4 * c + k] += g[c] * from[k];
    for (uint k = 0; k < 3; ++k)
      gradient[3 * i + k] =
          matrix[k] * g[0] + matrix[4 + k] * g[1] + matrix[8 + k] * g[2];
  }
  for (uint t = 0; t < TERMS; ++t)
    parts[t][lane] = sum[t];
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lane < TERMS) {
    float total = 0.0f;
    for (uint k = 0; k < LANES; ++k)
      total += parts[lane][k];
    sums[get_group_id(0) * TERMS + lane] = total;
  }
}
