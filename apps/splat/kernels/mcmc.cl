// Density control as Markov chain Monte Carlo (Kheradmand et al. 2024): a
// Gaussian that is nearly transparent moves to one that is drawn by opacity,
// more are drawn until there is no more room, and all take small random steps.
// What several that lie at one place draw together is what the one drew before.
//
// Draws are by integer weights, whose sums are exact, and every number comes
// from a counter: nothing depends on an order of arrival.

#include "activate.cl"
#include "axes.cl"
#include "layout.h"
#include "philox.h"

// The largest opacity below 1, and the most that share one place.
#define MOST_OPACITY 0.99999988f
#define MOST_SHARES 51

static float4 activated_scales(__global const float *geometry, uint count,
                               uint i) {
  return activate_scales_and_opacity(
      (float4)(geometry[PLANE_LOG_SCALE * count + i],
               geometry[(PLANE_LOG_SCALE + 1) * count + i],
               geometry[(PLANE_LOG_SCALE + 2) * count + i],
               geometry[PLANE_LOGIT * count + i]));
}

// Weights by which Gaussians are drawn, up to `scale` each, and 1 in `dead` for
// those with at most `dead_logit`, whose weight is 0.
__kernel void mcmc_weigh(__global const float *geometry,
                         __global uint *weights, __global uint *dead,
                         uint count, float dead_logit, float scale) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  // What is no number is dead, too.
  const bool alive = geometry[PLANE_LOGIT * count + i] > dead_logit;
  dead[i] = alive ? 0 : 1;
  weights[i] =
      alive ? max((uint)(activated_scales(geometry, count, i).w * scale), 1u)
            : 0;
}

// The numbers of the dead, in their order; `places` are their prefix sums.
__kernel void mcmc_list(__global const uint *dead, __global const uint *places,
                        __global uint *list, uint count) {
  const uint i = get_global_id(0);
  if (i < count && dead[i])
    list[places[i]] = i;
}

// Draws `draws` of the Gaussians by weights, of which `sums` are the prefix
// sums and `total` is the sum, and counts how often each was drawn.
__kernel void mcmc_draw(__global const uint *sums, __global uint *sources,
                        __global uint *drawn, uint count, uint draws,
                        uint total, uint seed_low, uint seed_high, uint kind,
                        uint iteration) {
  const uint j = get_global_id(0);
  if (j >= draws)
    return;
  const uint word =
      philox(seed_low, seed_high, j, kind, iteration, STREAM_DRAW).word[0];
  const uint wanted = mul_hi(word, total);
  // sums[low] <= wanted < sums[high]
  uint low = 0, high = count;
  while (high - low > 1) {
    const uint middle = low + (high - low) / 2;
    if (sums[middle] <= wanted)
      low = middle;
    else
      high = middle;
  }
  sources[j] = low;
  atomic_inc(drawn + low);
}

// The opacity that `shares` Gaussians need to have the opacity `all` together.
static float shared_opacity(float all, float shares) {
  return -expm1(log1p(-all) / shares);
}

// By how much their scales change, so that they draw as much as one did on
// every line through the centre. For the opacity o the one has o sqrt(2 pi)
// times its scale; `shares` of opacity x have the integral over t of
// 1 - (1 - x e^(-t^2 / 2))^shares. Kheradmand et al., equation 9, expand the
// power into a sum of binomials whose terms cancel. The integrand is even,
// smooth and falls like e^(-t^2 / 2), so that a few steps of the trapezoidal
// rule are exact to fp32.
static float shared_scale(float all, float one, float shares) {
  const float step = 0.21875f;
  float sum = 0.5f * all;
  for (uint k = 1; k <= 32; ++k) {
    const float t = step * (float)k;
    sum -= expm1(shares * log1p(-one * exp(-0.5f * t * t)));
  }
  return all * 1.2533141373f / (step * sum); // sqrt(pi / 2)
}

// Each that was drawn gives opacity and scale to itself and its copies.
__kernel void mcmc_share(__global float *geometry, __global const uint *drawn,
                         uint count, float least_opacity) {
  const uint i = get_global_id(0);
  if (i >= count || drawn[i] == 0)
    return;
  const float all =
      fmin(activated_scales(geometry, count, i).w, MOST_OPACITY);
  const float shares = (float)min(drawn[i] + 1, (uint)MOST_SHARES);
  const float one = shared_opacity(all, shares);
  const float shift = log(shared_scale(all, one, shares));
  const float kept = clamp(one, least_opacity, MOST_OPACITY);
  geometry[PLANE_LOGIT * count + i] = log(kept) - log1p(-kept);
  for (uint k = 0; k < 3; ++k)
    geometry[(PLANE_LOG_SCALE + k) * count + i] += shift;
}

// An optimiser's moments of those that were drawn begin again.
__kernel void mcmc_forget(__global float *moments, __global const uint *drawn,
                          uint count) {
  const uint i = get_global_id(0);
  if (i < count && drawn[i])
    moments[get_global_id(1) * count + i] = 0.0f;
}

// The dead become copies of their sources: of a plane for each second index.
__kernel void mcmc_move(__global uint *values, __global const uint *sources,
                        __global const uint *list, uint count, uint draws,
                        uint moments) {
  const uint j = get_global_id(0);
  if (j >= draws)
    return;
  __global uint *plane = values + get_global_id(1) * count;
  plane[list[j]] = moments ? 0 : plane[sources[j]];
}

// As mcmc_move, to places behind the `count` that there were.
__kernel void mcmc_grow(__global const uint *in, __global uint *out,
                        __global const uint *sources, uint count,
                        uint new_count, uint moments) {
  const uint i = get_global_id(0);
  if (i >= new_count)
    return;
  const uint plane = get_global_id(1);
  const bool is_new = i >= count;
  const uint from = is_new ? sources[i - count] : i;
  out[plane * new_count + i] =
      moments && is_new ? 0 : in[plane * count + from];
}

// Identities of copies (density.cl) follow from their sources'. Only those of
// `list`, or behind `count` where it is not used, are written.
__kernel void mcmc_identify(__global uint *identities,
                            __global const uint *sources,
                            __global const uint *list, uint use_list,
                            uint count, uint draws, uint seed_low,
                            uint seed_high, uint iteration) {
  const uint j = get_global_id(0);
  if (j < draws)
    identities[use_list ? list[j] : count + j] =
        philox(seed_low, seed_high, identities[sources[j]], j, iteration,
               STREAM_CHILD)
            .word[0];
}

// A random step: normal numbers times the covariance, in units of `rate`, for
// those that are nearly transparent; an opaque one stays where it is.
__kernel void mcmc_noise(__global float *geometry,
                         __global const uint *identities, uint count,
                         uint seed_low, uint seed_high, uint iteration,
                         float rate) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const float4 scale = activated_scales(geometry, count, i);
  const axes_of_gaussian axes = gaussian_axes(geometry, count, i);
  float normal[3];
  normal_numbers(philox(seed_low, seed_high, identities[i], 0, iteration,
                        STREAM_NOISE),
                 normal);
  const float3 n = (float3)(normal[0], normal[1], normal[2]);
  // As in the authors' code: 1/2 at an opacity of 0.005, with a slope of 100.
  const float share = rate / (1.0f + exp(100.0f * (scale.w - 0.005f)));
  const float squares[3] = {scale.x * scale.x, scale.y * scale.y,
                            scale.z * scale.z};
  float3 step = (float3)(0.0f);
  for (uint k = 0; k < 3; ++k)
    step += axes.axis[k] * (squares[k] * dot(axes.axis[k], n) * share);
  const float shift[3] = {step.x, step.y, step.z};
  for (uint k = 0; k < 3; ++k)
    geometry[(PLANE_MEAN + k) * count + i] += shift[k];
}
