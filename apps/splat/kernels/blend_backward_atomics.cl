// Blending's way back by the cores alone as INRIA's program has it (Kerbl et al.
// 2023): a work-item a pixel goes through the tile's list from its end, in
// batches that lie in local memory, and adds what each Gaussian gets to the
// Gaussian's sums in memory, by atomics. It is there to be measured: what the
// paper's rasterizer is compared with are kernels that sum so.

// As many as blend.cl has.
#define BATCH 64
#define TILE_PIXELS (TILE_SIZE * TILE_SIZE)

// OpenCL C 1.2 has no atomic sum of floats: whoever finds another value than the
// one added to adds again.
static void atomic_sum(volatile __global float *to, float value) {
  volatile __global uint *word = (volatile __global uint *)to;
  uint expected = *word;
  for (;;) {
    const uint found = atomic_cmpxchg(
        word, expected, as_uint(as_float(expected) + value));
    if (found == expected)
      return;
    expected = found;
  }
}

__kernel __attribute__((reqd_work_group_size(TILE_PIXELS, 1, 1))) void
blend_backward_atomics(__global const splat_gaussian *records,
                       __global const uint *list, __global const uint2 *ranges,
                       __global const float4 *pixels,
                       __global const uint *last,
                       __global const float4 *upstream, __global float *sums,
                       uint count, uint width, uint height) {
  __local splat_gaussian batch[BATCH];
  __local uint gaussians[BATCH];
  __local float4 gradient[TILE_PIXELS];
  __local float2 state[TILE_PIXELS];

  const uint item = get_local_id(0);
  const uint x = get_group_id(0) * TILE_SIZE + item % TILE_SIZE;
  const uint y = get_group_id(1) * TILE_SIZE + item / TILE_SIZE;
  const uint2 range =
      ranges[get_group_id(1) * get_num_groups(0) + get_group_id(0)];
  const bool inside = x < width && y < height;
  const uint i = inside ? y * width + x : 0;
  const uint own_last = inside ? last[i] : 0;
  gradient[item] = upstream[i];
  state[item] = (float2)(pixels[i].w, upstream[i].w);
  const float px = (float)x + 0.5f, py = (float)y + 0.5f;

  for (uint left = range.y - range.x; left != 0;) {
    const uint entries = min((uint)BATCH, left);
    for (uint e = item; e < entries; e += TILE_PIXELS) {
      gaussians[e] = list[range.x + left - 1 - e] & ~SPANS_TILES;
      batch[e] = records[gaussians[e]];
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint e = 0; e < entries; ++e) {
      if (left - 1 - e >= own_last)
        continue;
      __local const splat_gaussian *g = &batch[e];
      const float dx = g->mean[0] - px, dy = g->mean[1] - py;
      const float power =
          -0.5f * (g->conic[0] * dx * dx + g->conic[2] * dy * dy) -
          g->conic[1] * dx * dy;
      if ((fabs(dx) > g->extent[0]) | (fabs(dy) > g->extent[1]) |
          !((power <= 0.0f) & (power >= MIN_POWER)))
        continue;
      float sum[ALL_SUMS] = {0.0f};
      if (!pixel_backward(g, dx, dy, power, gradient + item, state + item, sum))
        continue;
      for (uint k = 0; k < ALL_SUMS; ++k)
        atomic_sum(sums + k * count + gaussians[e], sum[k]);
    }
    // Nobody may refill the batch before all have gone through it.
    barrier(CLK_LOCAL_MEM_FENCE);
    left -= entries;
  }
}

__kernel void clear_sums(__global float *sums, uint words) {
  const uint i = get_global_id(0);
  if (i < words)
    sums[i] = 0.0f;
}
