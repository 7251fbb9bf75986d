// Density control (Kerbl et al. 2023, section 5): which Gaussians are cloned,
// split or dropped, and the new arrays. Places come from a prefix sum over the
// number of Gaussians that each becomes, so the new order is that of the old
// ones, what one becomes side by side: it depends on no order of arrival.

#include "activate.cl"
#include "axes.cl"
#include "layout.h"
#include "philox.h"
#include "record.h"

enum { FATE_DROP = 0, FATE_KEEP = 1, FATE_CLONE = 2, FATE_SPLIT = 3 };

static uint becomes(uint fate) {
  return fate == FATE_DROP ? 0 : fate == FATE_KEEP ? 1 : 2;
}

// INRIA's radius of a projected Gaussian, px: three standard deviations along
// its longest axis, rounded up. The covariance is the conic's inverse; of rays
// the conic is that of those near the mean.
static float screen_radius(splat_record g) {
#if USE_RAYS
  const float a = g.factor[0], b = g.factor[1], c = g.factor[2];
  const float3 conic = (float3)(a * a, a * b, b * b + c * c);
  const float det = a * a * (c * c);
#else
  const float3 conic = (float3)(g.conic[0], g.conic[1], g.conic[2]);
  const float det = conic.x * conic.z - conic.y * conic.y;
#endif
  const float xx = conic.z / det, yy = conic.x / det;
  const float xy = -conic.y / det;
  const float half_difference = (xx - yy) / 2.0f;
  const float spread = half_difference * half_difference + xy * xy;
  return ceil(3.0f * sqrt((xx + yy) / 2.0f + sqrt(fmax(0.1f, spread))));
}

// Notes what one view says about the Gaussians that it saw: the length of the
// loss's gradient by the projected mean in units of half the picture, how often
// it was seen, and its largest radius. A radius that is no number stays out. The
// gradients by x and y are planes of floats, the first at `plane`.
__kernel void density_note(__global const splat_record *records,
                           __global const uint *depths,
                           __global const float *gradients, uint plane,
                           __global float *sums, __global uint *views,
                           __global float *radii, uint count, float half_width,
                           float half_height) {
  const uint i = get_global_id(0);
  if (i >= count || depths[i] >= CULLED)
    return;
  const float x = gradients[plane * count + i] * half_width;
  const float y = gradients[(plane + 1) * count + i] * half_height;
  sums[i] += sqrt(x * x + y * y);
  views[i] += 1;
  radii[i] = fmax(radii[i], screen_radius(records[i]));
}

// What becomes of each Gaussian, and how many; `keys` orders those that grow by
// falling gradient (the bits of a float that is not negative rise with it).
__kernel void density_decide(__global const float *geometry,
                             __global const float *sums,
                             __global const uint *views,
                             __global const float *radii, __global uint *fates,
                             __global uint *counts, __global uint *keys,
                             __global uint *order, uint count,
                             splat_density rule) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const float largest =
      fmax(fmax(geometry[PLANE_LOG_SCALE * count + i],
                geometry[(PLANE_LOG_SCALE + 1) * count + i]),
           geometry[(PLANE_LOG_SCALE + 2) * count + i]);
  const float gradient = views[i] > 0 ? sums[i] / (float)views[i] : 0.0f;
  const bool grows = gradient > rule.gradient;
  const bool splits = grows && largest > rule.split_log_scale;
  // The halves of a split have no radius yet.
  const float log_scale = splits ? largest - rule.split_shrink : largest;
  const bool drops =
      geometry[PLANE_LOGIT * count + i] < rule.least_logit ||
      log_scale > rule.most_log_scale ||
      (!splits && radii[i] > rule.most_radius);
  const uint fate = drops    ? FATE_DROP
                    : splits ? FATE_SPLIT
                    : grows  ? FATE_CLONE
                             : FATE_KEEP;
  fates[i] = fate;
  counts[i] = becomes(fate);
  keys[i] = becomes(fate) == 2 ? ~as_uint(gradient) : 0xffffffffu;
  order[i] = i;
}

// Where there is room for `most` more only: those with the largest gradients
// grow, the others stay as they are. `order` is sorted by `keys`.
__kernel void density_limit(__global const uint *order, __global uint *fates,
                            __global uint *counts, uint count, uint most) {
  const uint rank = get_global_id(0);
  if (rank >= count || rank < most)
    return;
  const uint i = order[rank];
  if (counts[i] == 2) {
    fates[i] = FATE_KEEP;
    counts[i] = 1;
  }
}

// Whether each grows, for counting them.
__kernel void density_grows(__global const uint *counts, __global uint *grows,
                            uint count) {
  const uint i = get_global_id(0);
  if (i < count)
    grows[i] = counts[i] == 2 ? 1 : 0;
}

// One plane for each second index: what is kept keeps its values. Of a clone
// both have the parameters (`moments` 0); an optimiser's moments stay with the
// original alone, and those of a split begin at 0.
__kernel void density_copy(__global const float *in, __global float *out,
                           __global const uint *fates,
                           __global const uint *places, uint count,
                           uint new_count, uint moments) {
  const uint i = get_global_id(0);
  if (i >= count || fates[i] == FATE_DROP)
    return;
  const uint plane = get_global_id(1);
  const float value = in[plane * count + i];
  const uint to = plane * new_count + places[i];
  const uint fate = fates[i];
  out[to] = moments && fate == FATE_SPLIT ? 0.0f : value;
  if (becomes(fate) == 2)
    out[to + 1] = moments ? 0.0f : value;
}

// Identities: random numbers are counted by them, not by places, so that what
// is decided about one Gaussian moves no other one's samples. What is kept, and
// the original of a clone, keeps its own; a new one's follows from its parent's.
// Of n Gaussians some n^2 / 2^33 pairs have the same one by chance, and then
// split alike if they do at the same iteration.
__kernel void density_identify(__global const uint *in, __global uint *out,
                               __global const uint *fates,
                               __global const uint *places, uint count,
                               uint seed_low, uint seed_high, uint iteration) {
  const uint i = get_global_id(0);
  if (i >= count || fates[i] == FATE_DROP)
    return;
  const uint children = becomes(fates[i]);
  out[places[i]] = in[i];
  for (uint child = fates[i] == FATE_SPLIT ? 0 : 1; child < children; ++child)
    out[places[i] + child] =
        philox(seed_low, seed_high, in[i], child, iteration, STREAM_CHILD)
            .word[0];
}

// A split's halves: at samples of the Gaussian that they replace, smaller.
__kernel void density_split(__global const float *geometry,
                            __global float *new_geometry,
                            __global const uint *identities,
                            __global const uint *fates,
                            __global const uint *places, uint count,
                            uint new_count, uint seed_low, uint seed_high,
                            uint iteration, float shrink) {
  const uint i = get_global_id(0);
  if (i >= count || fates[i] != FATE_SPLIT)
    return;
  const axes_of_gaussian axes = gaussian_axes(geometry, count, i);
  const float4 activated = activate_scales_and_opacity(
      (float4)(geometry[PLANE_LOG_SCALE * count + i],
               geometry[(PLANE_LOG_SCALE + 1) * count + i],
               geometry[(PLANE_LOG_SCALE + 2) * count + i], 0.0f));
  const float scale[3] = {activated.x, activated.y, activated.z};
  for (uint child = 0; child < 2; ++child) {
    const philox_words r =
        philox(seed_low, seed_high, identities[i], child, iteration,
               STREAM_SPLIT);
    float normal[3];
    normal_numbers(r, normal);
    float3 offset = (float3)(0.0f, 0.0f, 0.0f);
    const uint to = places[i] + child;
    for (uint k = 0; k < 3; ++k) {
      const float log_scale = geometry[(PLANE_LOG_SCALE + k) * count + i];
      offset += axes.axis[k] * (scale[k] * normal[k]);
      new_geometry[(PLANE_LOG_SCALE + k) * new_count + to] = log_scale - shrink;
    }
    const float shift[3] = {offset.x, offset.y, offset.z};
    for (uint k = 0; k < 3; ++k)
      new_geometry[(PLANE_MEAN + k) * new_count + to] =
          geometry[(PLANE_MEAN + k) * count + i] + shift[k];
  }
}

// Opacities down to at most that of `most_logit`.
__kernel void reset_opacity(__global float *geometry, uint count,
                            float most_logit) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const uint at = PLANE_LOGIT * count + i;
  geometry[at] = fmin(geometry[at], most_logit);
}

// A moment's plane begins again.
__kernel void forget_plane(__global float *moments, uint plane, uint count) {
  const uint i = get_global_id(0);
  if (i < count)
    moments[plane * count + i] = 0.0f;
}
