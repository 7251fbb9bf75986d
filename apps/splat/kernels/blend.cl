// Blending by the cores alone: a group of 16x16 work-items draws a tile, one
// pixel each, with the rasterizer's arithmetic in the rasterizer's order
// (docs/abi.md). The list goes through local memory in batches, and the group
// stops when none of its pixels can change any more.

#define BATCH 256

// True if a pixel with this transmittance takes no more.
#ifdef STOP_AT_EQUAL
#define SATURATED(t) ((t) <= cutoff)
#else
#define SATURATED(t) ((t) < cutoff)
#endif

__kernel __attribute__((reqd_work_group_size(TILE_SIZE, TILE_SIZE, 1))) void
blend(__global const splat_gaussian *records, __global const uint *list,
      __global const uint2 *ranges, __global float4 *pixels, uint width,
      uint height, float cutoff) {
  __local splat_gaussian batch[BATCH];
  __local uint live;

  const uint item = get_local_id(1) * TILE_SIZE + get_local_id(0);
  const uint x = get_global_id(0);
  const uint y = get_global_id(1);
  const float px = (float)x + 0.5f;
  const float py = (float)y + 0.5f;
  const uint2 range = ranges[get_group_id(1) * get_num_groups(0) +
                             get_group_id(0)];

  float red = 0.0f, green = 0.0f, blue = 0.0f, transmittance = 1.0f;
  bool done = x >= width || y >= height;
  bool group_live = true;
  for (uint base = range.x; base < range.y && group_live; base += BATCH) {
    const uint entries = min((uint)BATCH, range.y - base);
    if (item == 0)
      live = 0;
    if (item < entries)
      batch[item] = records[list[base + item]];
    barrier(CLK_LOCAL_MEM_FENCE);

    for (uint j = 0; j < entries && !done; ++j) {
      __local const splat_gaussian *g = &batch[j];
      const float dy = g->mean[1] - py;
      if (fabs(dy) <= g->extent[1]) {
        const float dx = g->mean[0] - px;
        const float power = -0.5f * (g->conic[0] * dx * dx +
                                     g->conic[2] * dy * dy) -
                            g->conic[1] * dx * dy;
        // Below MIN_POWER alpha is under 1/255 whatever the opacity, so the
        // exponential is not worth taking. False for NaN.
        if (fabs(dx) <= g->extent[0] && power <= 0.0f && power >= MIN_POWER) {
          const float alpha = fmin(0.99f, g->opacity * falloff(power));
          const float next = transmittance * (1.0f - alpha);
          // Without branches: most Gaussians that get here are blended, and a
          // weight of 0 changes no bit.
          const bool visible = alpha >= 1.0f / 255.0f;
          const bool full = visible & SATURATED(next);
          const bool blended = visible & !full;
          const float weight = blended ? alpha * transmittance : 0.0f;
          red += g->color[0] * weight;
          green += g->color[1] * weight;
          blue += g->color[2] * weight;
          transmittance = blended ? next : transmittance;
          done = full;
        }
      }
    }
    if (!done)
      atomic_or(&live, 1u);
    barrier(CLK_LOCAL_MEM_FENCE);
    group_live = live != 0;
    // Nobody may clear `live` or refill the batch before all have read it.
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (x < width && y < height)
    pixels[y * width + x] = (float4)(red, green, blue, transmittance);
}
