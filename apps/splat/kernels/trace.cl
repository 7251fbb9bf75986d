// Traced rays: a work-item takes a ray through the tree of bvh.cl, and blends
// the Gaussians that it meets in the order of where they are densest on it
// (Moenne-Loccoz et al. 2024), those at one place by number. A pass keeps the
// RAY_WINDOW nearest behind what the ray has blended; when they are blended and
// the ray is not opaque, the next pass begins: at the root, or where the one
// before left something (after GRTX, 2026). The picture has the same bits for
// every RAY_WINDOW and every tree.

// Gaussians that a ray finds in a pass.
#pragma vorion choice uint RAY_WINDOW
// A pass begins where the one before left something.
#pragma vorion choice flag CHECKPOINTS
// INRIA's rule: what lies in the near plane is not drawn.
#pragma vorion choice flag NEAR_IS_LEFT_OUT

#include "activate.cl"
#include "blend_rules.cl"
#include "falloff_degree.h"
#include "layout.h"

#include <vorion.h>

#define DONE 0u // no node
#define NONE 0xffffffffu

// Rounding may bring a box's beginning and end on a ray so much nearer.
#define WAY_ROUNDING 1e-6f

typedef struct {
  float origin[3], origin_low[3], direction[3], direction_low[3];
  float reciprocal[3]; // of the direction
} traced_ray;

// Where a ray meets a Gaussian: the exponent, and how many directions along.
typedef struct {
  float power, along;
} ray_hit;

// a b - c d of four sums of high + low, nothing of which is lost where the
// products are nearly equal.
static float difference_of_products(float2 a, float2 b, float2 c, float2 d) {
  const float p = a.x * b.x, q = c.x * d.x;
  const float rest = fma(a.x, b.x, -p) - fma(c.x, d.x, -q);
  return (p - q) + ((rest + (a.x * b.y + a.y * b.x)) -
                    (c.x * d.y + c.y * d.x));
}

// As reference/AlongRays.cpp has it: what lies beside the ray is a cross product
// in the world, which the Gaussian's axes see, and nothing is divided by a
// scale, so that discs are as good as any.
static ray_hit hit_of(__global const splat_traced *g, const traced_ray *r) {
  float2 from[3], along[3];
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float2 sum = two_sum(g->mean[k], -r->origin[k]);
    from[k] = fast_two_sum(sum.x, sum.y + (g->mean_low[k] - r->origin_low[k]));
    along[k] = (float2)(r->direction[k], r->direction_low[k]);
  }
  float beside[3];
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    beside[k] =
        difference_of_products(from[i], along[j], from[j], along[i]);
  }
  float across = 0.0f, both = 0.0f, ahead = 0.0f;
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float others = g->scale[(k + 1) % 3] * g->scale[(k + 2) % 3];
    float off = 0.0f, way = 0.0f, mean = 0.0f;
#pragma unroll
    for (int a = 0; a < 3; ++a) {
      const float axis = g->axes[3 * k + a];
      off += axis * beside[a];
      way += axis * r->direction[a];
      mean += axis * from[a].x;
    }
    off *= g->scale[k];
    way *= others;
    across += off * off;
    both += way * (others * mean);
    ahead += way * way;
  }
  const float square = across / ahead * g->sharpness;
  return (ray_hit){POWER_AT(square), both / ahead};
}

// The nearest Gaussian comes first. Empty places have alpha 0.
typedef struct {
  float along[RAY_WINDOW], alpha[RAY_WINDOW];
  uint number[RAY_WINDOW];
} hit_window;

static bool comes_before(float along, uint number, float other,
                         uint other_number) {
  return (along < other) | ((along == other) & (number < other_number));
}

// In its place, for the farthest, whose number it returns.
static uint insert(hit_window *w, float along, float alpha, uint number) {
#pragma unroll
  for (int k = 0; k < RAY_WINDOW; ++k) {
    const float d = w->along[k], a = w->alpha[k];
    const uint n = w->number[k];
    const bool before = comes_before(along, number, d, n);
    w->along[k] = before ? along : d;
    w->alpha[k] = before ? alpha : a;
    w->number[k] = before ? number : n;
    along = before ? d : along;
    alpha = before ? a : alpha;
    number = before ? n : number;
  }
  return number;
}

// Whether the ray is in the box somewhere from `nearest` to `farthest`.
static bool meets(__global const float *box, const traced_ray *r,
                  float nearest, float farthest) {
  float enter = -INFINITY, leave = INFINITY;
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    const float a = (box[BOX_LOW + k] - r->origin[k]) * r->reciprocal[k];
    const float b = (box[BOX_HIGH + k] - r->origin[k]) * r->reciprocal[k];
    enter = fmax(enter, fmin(a, b));
    leave = fmin(leave, fmax(a, b));
  }
  const float first = enter - WAY_ROUNDING * fabs(enter);
  const float last = leave + WAY_ROUNDING * fabs(leave);
  return (first <= last) & (first <= farthest) & (last >= nearest);
}

// The first leaf below a node.
static uint first_leaf(uint node, splat_tree tree) {
  return (node << (clz(node) - clz(tree.leaves))) - tree.leaves;
}

// The highest ancestor from which first children lead down to the node.
static uint ancestor_by_first(uint node) {
  // Nodes of a level begin at a power of 4, so the zeros of base 4 at the end of
  // the number are the levels.
  const uint zeros = 31u - clz(node & -node);
  return node >> (zeros & ~1u);
}

// The next node that is not below this one: of the same parent, or where a
// parent has no more, of the parent's. The root has none.
static uint node_after(uint node) {
  const uint up = ancestor_by_first(node + 1);
  return up <= 2 ? DONE : up;
}

#ifdef NEAR_IS_LEFT_OUT
#define IS_FROM(along, nearest) ((along) > (nearest))
#else
#define IS_FROM(along, nearest) ((along) >= (nearest))
#endif

// A group is a warp and takes blocks of 4x4 rays, which lie in a picture of
// `width` and `height`. With `onward` they go on from what other rays have left
// of the pixels.
__kernel __attribute__((reqd_work_group_size(16, 1, 1))) void
trace(__global const float *rays, __global const float *nodes,
      __global const uint *order, __global const uint *leaves,
      __global const splat_traced *shapes,
      __global const float4 *colors, __global float4 *pixels,
      __global splat_ray_work *work, splat_tree tree, uint width, uint height,
      float cutoff, uint effects, uint onward) {
  const uint lane = get_local_id(0);
  const uint x = get_group_id(0) * 4 + lane % 4;
  const uint y = get_group_id(1) * 4 + lane / 4;
  const uint i = min(y, height - 1) * width + min(x, width - 1);
  const uint count = width * height;
  traced_ray r;
#pragma unroll
  for (int k = 0; k < 3; ++k) {
    r.origin[k] = rays[(RAY_ORIGIN + k) * count + i];
    r.origin_low[k] = rays[(RAY_ORIGIN_LOW + k) * count + i];
    r.direction[k] = rays[(RAY_DIRECTION + k) * count + i];
    r.direction_low[k] = rays[(RAY_DIRECTION_LOW + k) * count + i];
    // Of what is nearly 0 a box's sides are far away, but numbers.
    r.reciprocal[k] =
        1.0f / copysign(fmax(fabs(r.direction[k]), 1e-30f), r.direction[k]);
  }
  const float nearest = rays[RAY_NEAREST * count + i];
  const float farthest = rays[RAY_FARTHEST * count + i];

  float red = 0.0f, green = 0.0f, blue = 0.0f, transmittance = 1.0f;
  splat_ray_work done = {0, 0, 0, 0};
  // What was blended last.
  float last = -INFINITY;
  uint last_number = 0;
  bool open = x < width && y < height && farthest > nearest;
  if (onward) {
    const float4 own = pixels[i];
    red = own.x;
    green = own.y;
    blue = own.z;
    transmittance = own.w;
    done = work[i];
  }
  uint start = 1;
  while (vx_vote_any(open)) {
    done.passes += open;
#ifdef CHECKPOINTS
    // The first leaf with what a later pass may blend.
    uint rest = NONE;
#endif
    hit_window w;
#pragma unroll
    for (int k = 0; k < RAY_WINDOW; ++k) {
      w.along[k] = INFINITY;
      w.alpha[k] = 0.0f;
      w.number[k] = NONE;
    }
    const float from = fmax(nearest, last);
    for (uint node = start; node != DONE;) {
      const bool is_leaf = node >= tree.leaves;
      __global const float *box =
          nodes + BOX_WORDS * (node - (is_leaf ? tree.gap : 0));
      const bool is_met =
          open &
          meets(box, &r, from, fmin(w.along[RAY_WINDOW - 1], farthest));
#ifdef CHECKPOINTS
      if (!is_met & meets(box, &r, from, farthest))
        rest = min(rest, first_leaf(node, tree));
#endif
      done.nodes += open;
      const uint leaf = node - tree.leaves;
      // The warp goes where one of its rays does.
      node = !is_leaf && vx_vote_any(is_met) ? 4 * node : node_after(node);
      if (!(is_met & is_leaf))
        continue;
      ++done.evaluated;
      const uint number = order[leaf];
      __global const splat_traced *g = &shapes[number];
      const ray_hit hit = hit_of(g, &r);
      // False for NaN.
      if (!((hit.power <= 0.0f) & IS_VISIBLE_POWER(hit.power) &
            IS_FROM(hit.along, nearest) & (hit.along < farthest) &
            comes_before(last, last_number, hit.along, number)))
        continue;
      if (!comes_before(hit.along, number, w.along[RAY_WINDOW - 1],
                        w.number[RAY_WINDOW - 1])) {
#ifdef CHECKPOINTS
        rest = min(rest, leaf);
#endif
        continue;
      }
      const float alpha =
          clamped_alpha(g->opacity * falloff(hit.power), effects);
      if (alpha >= ALPHA_CUTOFF / 255.0f) {
        const uint evicted = insert(&w, hit.along, alpha, number);
#ifdef CHECKPOINTS
        if (evicted != NONE)
          rest = min(rest, leaves[evicted]);
#endif
      }
    }
#pragma unroll
    for (int k = 0; k < RAY_WINDOW; ++k) {
      if (open) {
        const float next = transmittance * (1.0f - w.alpha[k]);
        // An empty place: there is no more.
        open = (w.alpha[k] != 0.0f) & !(SATURATED(next));
        if (open) {
          const float4 color = colors[w.number[k]];
          const float weight = w.alpha[k] * transmittance;
          red += color.x * weight;
          green += color.y * weight;
          blue += color.z * weight;
          transmittance = next;
          ++done.blended;
        }
      }
    }
    last = w.along[RAY_WINDOW - 1];
    last_number = w.number[RAY_WINDOW - 1];
#ifdef CHECKPOINTS
    open &= rest != NONE;
    start = ancestor_by_first(
        tree.leaves + sub_group_reduce_min(open ? rest : NONE - tree.leaves));
#endif
  }
  if (x < width && y < height) {
    pixels[i] = (float4)(red, green, blue, transmittance);
    work[i] = done;
  }
}
