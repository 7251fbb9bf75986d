// Blending's way back by the cores alone: 16 work-items go through a tile's list
// from its end, with the arithmetic of docs/abi.md, "Backward". Each owns
// every 16th pixel; 16 Gaussians at a time are summed over the work-items, one
// Gaussian a work-item, in a fixed order and without atomics.

#define LANES 16
#define PIXELS (TILE_SIZE * TILE_SIZE)
#define OWN (PIXELS / LANES)

#ifdef CLAMP_STOPS
#define CLAMPED(wanted) ((wanted) > 0.99f)
#else
#define CLAMPED(wanted) false
#endif

// For density control, also the sums of the absolute gradients by the mean (Ye
// et al. 2024, "AbsGS"): what pulls both ways does not cancel.
#ifdef ABSOLUTE_SUMS
#define ALL_SUMS (SUM_WORDS + ABSOLUTE_SUMS)
#else
#define ALL_SUMS SUM_WORDS
#endif

// One Gaussian in all pixels of this work-item: adds to `sum`.
static void through(__global const splat_gaussian *g, uint entry, uint x0,
                    uint y0, __local const float4 *gradient,
                    __local float2 *state, __local const uint *last,
                    float *sum) {
  const uint lane = get_local_id(0);
  const float mean_x = g->mean[0], mean_y = g->mean[1];
  const float a = g->conic[0], b = g->conic[1], c = g->conic[2];
  const float extent_x = g->extent[0], extent_y = g->extent[1];
  for (uint k = 0; k < OWN; ++k) {
    const uint place = k * LANES + lane;
    const float dx = mean_x - ((float)(x0 + place % TILE_SIZE) + 0.5f);
    const float dy = mean_y - ((float)(y0 + place / TILE_SIZE) + 0.5f);
    const float power = -0.5f * (a * dx * dx + c * dy * dy) - b * dx * dy;
    if ((last[place] > entry) & (fabs(dx) <= extent_x) &
        (fabs(dy) <= extent_y) & (power <= 0.0f) & (power >= MIN_POWER)) {
      const float wanted = g->opacity * falloff(power);
      const float alpha = fmin(0.99f, wanted);
      if (alpha >= ALPHA_CUTOFF / 255.0f) {
        const float4 u = gradient[place];
        const float2 s = state[place]; // transmittance, light from behind
        const float t = s.x / (1.0f - alpha);
        const float light =
            g->color[0] * u.x + g->color[1] * u.y + g->color[2] * u.z;
        const float gain = light - s.y;
        state[place] = (float2)(t, s.y + alpha * gain);
        const float weight = alpha * t;
        const float v = CLAMPED(wanted) ? 0.0f : wanted * (t * gain);
        const float vx = v * -dx, vy = v * -dy;
        sum[SUM_COLOR] += weight * u.x;
        sum[SUM_COLOR + 1] += weight * u.y;
        sum[SUM_COLOR + 2] += weight * u.z;
        sum[SUM_S] += v;
        sum[SUM_SX] += vx;
        sum[SUM_SX + 1] += vy;
        sum[SUM_SXX] += vx * -dx;
        sum[SUM_SXX + 1] += vx * -dy;
        sum[SUM_SXX + 2] += vy * -dy;
#ifdef ABSOLUTE_SUMS
        sum[SUM_WORDS] += fabs(a * vx + b * vy);
        sum[SUM_WORDS + 1] += fabs(b * vx + c * vy);
#endif
      }
    }
  }
}

__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
blend_backward(__global const splat_gaussian *records,
               __global const uint *list, __global const uint2 *ranges,
               __global const float4 *pixels, __global const uint *last,
               __global const float4 *upstream, __global const uint *places,
               __global float *sums, uint width, uint height) {
  __local float4 gradient[PIXELS];
  __local float2 state[PIXELS];
  __local uint entries[PIXELS];
  __local float parts[LANES][ALL_SUMS][LANES]; // [Gaussian][sum][work-item]
  __local uint most[LANES];

  const uint lane = get_local_id(0);
  const uint x0 = get_group_id(0) * TILE_SIZE;
  const uint y0 = get_group_id(1) * TILE_SIZE;
  const uint2 range =
      ranges[get_group_id(1) * get_num_groups(0) + get_group_id(0)];
  uint own_most = 0;
  for (uint k = 0; k < OWN; ++k) {
    const uint place = k * LANES + lane;
    const uint x = x0 + place % TILE_SIZE, y = y0 + place / TILE_SIZE;
    const bool inside = x < width && y < height;
    const uint i = inside ? y * width + x : 0;
    gradient[place] = upstream[i];
    state[place] = (float2)(pixels[i].w, upstream[i].w);
    entries[place] = inside ? last[i] : 0;
    own_most = max(own_most, entries[place]);
  }
  most[lane] = own_most;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint left = 0;
  for (uint k = 0; k < LANES; ++k)
    left = max(left, most[k]);

  for (uint i = range.x + left + lane; i < range.y; i += LANES)
    for (uint k = 0; k < ALL_SUMS; ++k)
      sums[places[i] * ALL_SUMS + k] = 0.0f;
  while (left != 0) {
    const uint first = (left - 1) / LANES * LANES;
    for (uint entry = left; entry-- > first;) {
      float sum[ALL_SUMS] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f,
                              0.0f, 0.0f, 0.0f, 0.0f};
      through(records + (list[range.x + entry] & ~SPANS_TILES), entry, x0, y0,
              gradient, state, entries, sum);
      for (uint k = 0; k < ALL_SUMS; ++k)
        parts[entry - first][k][lane] = sum[k];
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (first + lane < left) {
      __global float *to = sums + places[range.x + first + lane] * ALL_SUMS;
      for (uint k = 0; k < ALL_SUMS; ++k) {
        __local const float *p = parts[lane][k];
        // As a tree, halves onto halves.
        const float c0 = (p[0] + p[8]) + (p[4] + p[12]);
        const float c1 = (p[1] + p[9]) + (p[5] + p[13]);
        const float c2 = (p[2] + p[10]) + (p[6] + p[14]);
        const float c3 = (p[3] + p[11]) + (p[7] + p[15]);
        to[k] = (c0 + c2) + (c1 + c3);
      }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    left = first;
  }
}
