/* Draws recorded triangles by Skybox's rules (github.com/vortexgpgpu/skybox):
   kernels set triangles up and shade, the rasterizer finds the pixels that they
   cover. Integers are 16.16 for edges and 8.24 for attributes, as Skybox's. */
#include <vorion_raster.h>
#include <vorion_triangles.h>

#pragma OPENCL FP_CONTRACT OFF

#define LANES 16u
#define TILE 32u /* Skybox's tile: it cuts a triangle to the tiles of its box */
#define DEPTH_BITS 24

enum { NEVER, LESS, EQUAL, LEQUAL, GREATER, NOTEQUAL, GEQUAL, ALWAYS };
/* Of a vertex: depth, red, green, blue, alpha, u, v. */
enum { Z, RED, U = 5, V, ATTRIBUTES };

/* A draw, as trace.py fills it in. */
typedef struct {
  uint width, height; /* of the target, px */
  float near, far;    /* of depth */
  uint triangles;
  uint depth_test, depth_write, depth_function;
  uint textured, log_width, log_height, linear, clamped, modulated;
  uint blended, source, destination;
} draw_state;

/* An attribute in 8.24: first and second corner's value less the third's, and
   the third's. */
typedef struct {
  int first, second, third;
} corners;

typedef struct {
  corners of[ATTRIBUTES];
} attributes;

static int fixed(float value) {
  return convert_int_sat_rtz(value * 16777216.0f);
}

static corners in_corners(float a, float b, float c) {
  const corners all = {fixed(a - c), fixed(b - c), fixed(c)};
  return all;
}

/* In homogeneous coordinates of the target. */
static float4 on_target(constant const draw_state *s, float4 clip) {
  const float x = (float)s->width / 2, y = (float)s->height / 2;
  return (float4)(clip.x * x + clip.w * x, clip.y * y + clip.w * y, clip.z,
                  clip.w);
}

/* First and last column (or row) between two places that a coordinate of the
   three corners has, cut to Skybox's tiles. */
typedef struct {
  int first, last;
} extent;

static extent of_tiles(const float at[3], uint size) {
  const float low = floor(fmin(fmin(at[0], at[1]), at[2]));
  const float high = ceil(fmax(fmax(at[0], at[1]), at[2]));
  const int begin = convert_int_sat(fmax(low, 0.0f));
  const int end = convert_int_sat(fmin(high, (float)size));
  extent e = {0, -1};
  if (begin < end) {
    e.first = begin / (int)TILE * (int)TILE;
    e.last = min((end + (int)TILE - 1) / (int)TILE * (int)TILE, (int)size) - 1;
  }
  return e;
}

/* `e` cut to where three edges can hold at once, if that is a triangle: edges
   that were rounded meet elsewhere than at the corners. The quotients are off
   by at most 3 x 2^-24 of themselves, which is less than the 1/16 added. */
static extent of_edges(extent e, const long numerators[3],
                       const long divisors[3]) {
  float low = INFINITY, high = -INFINITY;
  for (int k = 0; k != 3; ++k) {
    const float at = (float)numerators[k] / (float)divisors[k];
    low = fmin(low, at);
    high = fmax(high, at);
  }
  e.first = max(e.first, convert_int_sat_rtp(low - 0.0625f));
  e.last = min(e.last, convert_int_sat_rtn(high + 0.0625f));
  return e;
}

/* The unit's record of triangle `i`: its edges, and as a constant depth the
   least that any of its pixels can have. A triangle that covers nothing gets a
   box without pixels. */
kernel void set_up(constant const draw_state *s, global const float4 *clip,
                   global const float *colors, global const float2 *uv,
                   global const int *triangles, global vx_triangle *records,
                   global attributes *values) {
  const uint i = get_global_id(0);
  if (i >= s->triangles)
    return;
  float4 p[3];
  float a[3], b[3], c[3], x[3], y[3], z[3], largest = 0.0f, area = 0.0f;
  for (int k = 0; k != 3; ++k) {
    const float4 from = clip[triangles[3 * i + k]];
    p[k] = on_target(s, from);
    const float once = 1.0f / p[k].w;
    x[k] = p[k].x * once;
    y[k] = p[k].y * once;
    z[k] = from.z * once * ((s->far - s->near) / 2) + (s->near + s->far) / 2;
  }
  for (int k = 0; k != 3; ++k) {
    const float4 from = p[(k + 1) % 3], to = p[(k + 2) % 3];
    a[k] = from.y * to.w - to.y * from.w;
    b[k] = to.x * from.w - from.x * to.w;
    c[k] = from.x * to.y - to.x * from.y;
    largest = fmax(largest, fmax(fabs(a[k]), fabs(b[k])));
  }
  area = c[0] * p[0].w + c[1] * p[1].w + c[2] * p[2].w;
  const float scale = (area < 0.0f ? -1.0f : 1.0f) / largest;
  vx_triangle t;
  bool drawn = area != 0.0f && isfinite(area) && isfinite(scale);
  long edge[3];
  for (int k = 0; k != 3; ++k) {
    /* The sample is at the pixel's centre. Negation changes no rounding. */
    const float at = (c[k] + (a[k] * 0.5f + b[k] * 0.5f)) * scale;
    drawn &= isfinite(at);
    t.a[k] = (int)(a[k] * scale * 65536.0f);
    t.b[k] = (int)(b[k] * scale * 65536.0f);
    edge[k] = convert_long_sat_rtz(at * 65536.0f);
    t.c_low[k] = (uint)edge[k];
    t.c_high[k] = (int)(edge[k] >> 32);
  }
  extent columns = of_tiles(x, s->width), rows = of_tiles(y, s->height);
  long along_x[3], along_y[3], divisors[3];
  int turns = 0; /* 3 or -3: the edges enclose a triangle. */
  for (int k = 0; k != 3; ++k) {
    const int n = (k + 1) % 3;
    along_x[k] = (long)t.b[k] * edge[n] - (long)t.b[n] * edge[k];
    along_y[k] = (long)t.a[n] * edge[k] - (long)t.a[k] * edge[n];
    divisors[k] = (long)t.a[k] * t.b[n] - (long)t.a[n] * t.b[k];
    if (edge[k] == (int)edge[k])
      turns += (divisors[k] > 0) - (divisors[k] < 0);
  }
  if (abs(turns) == 3) {
    columns = of_edges(columns, along_x, divisors);
    rows = of_edges(rows, along_y, divisors);
  }
  drawn &= columns.first <= columns.last && rows.first <= rows.last;
  t.first = drawn ? (uint)columns.first | (uint)rows.first << 16 : ~0u;
  t.last = drawn ? (uint)columns.last | (uint)rows.last << 16 : 0;
  /* Interpolation rounds down twice, and the three weights, of which each is
     off by 2^-23, may add up to more than 1. Depths that could wrap around have
     no bound. */
  const float nearest = fmin(fmin(z[0], z[1]), z[2]);
  const float farthest = fmax(fmax(z[0], z[1]), z[2]);
  const float margin = 16.0f / 16777216.0f;
  t.depth = nearest > margin && farthest < 1.0f - margin
                ? floor((nearest - margin) * 16777216.0f)
                : 0.0f;
  t.depth_step[0] = t.depth_step[1] = 0.0f;
  t.tag = i;
  records[i] = t;

  attributes own;
  const int v0 = triangles[3 * i], v1 = triangles[3 * i + 1],
            v2 = triangles[3 * i + 2];
  own.of[Z] = in_corners(z[0], z[1], z[2]);
  for (int k = 0; k != 4; ++k)
    own.of[RED + k] = in_corners(colors[4 * v0 + k], colors[4 * v1 + k],
                                 colors[4 * v2 + k]);
  own.of[U] = in_corners(uv[v0].x, uv[v1].x, uv[v2].x);
  own.of[V] = in_corners(uv[v0].y, uv[v1].y, uv[v2].y);
  values[i] = own;
}

static int at(const global corners *c, int first, int second) {
  return (int)((long)c->first * first >> 24) + c->third +
         (int)((long)c->second * second >> 24);
}

/* A coordinate of 23 fraction bits within the texture. */
static uint wrapped(constant const draw_state *s, int coordinate) {
  const int one = 1 << 23;
  return s->clamped ? clamp(coordinate, 0, one - 1) : coordinate & (one - 1);
}

static uint4 mixed(uint4 a, uint4 b, uint weight) {
  const uint4 p = a * (255 - weight) + b * weight + 128;
  return (p + (p >> 8)) >> 8;
}

static uint4 texel(constant const draw_state *s, global const uchar4 *texels,
                   uint u, uint v) {
  const uint x = u >> (23 - s->log_width), y = v >> (23 - s->log_height);
  return convert_uint4(texels[(y << s->log_width) + x]);
}

static uint4 sampled(constant const draw_state *s, global const uchar4 *texels,
                     int u, int v) {
  if (!s->linear)
    return texel(s, texels, wrapped(s, u), wrapped(s, v));
  const int half_u = 1 << (22 - s->log_width), half_v = 1 << (22 - s->log_height);
  const uint u0 = wrapped(s, u - half_u), u1 = wrapped(s, u + half_u);
  const uint v0 = wrapped(s, v - half_v), v1 = wrapped(s, v + half_v);
  const uint along_u = u0 >> (15 - s->log_width) & 255;
  const uint along_v = v0 >> (15 - s->log_height) & 255;
  return mixed(mixed(texel(s, texels, u0, v0), texel(s, texels, u1, v0), along_u),
               mixed(texel(s, texels, u0, v1), texel(s, texels, u1, v1), along_u),
               along_v);
}

/* Blend factors by number: 0, 1, source, 1 - source, alpha of the source,
   1 - it, alpha of the destination, 1 - it, destination, 1 - destination. */
static uint4 factor(uint number, uint4 source, uint4 destination) {
  const uint4 from[] = {(uint4)(0), source, (uint4)(source.w),
                        (uint4)(destination.w), destination};
  const uint4 value = from[number / 2];
  return number % 2 ? 255 - value : value;
}

static uint4 blended(constant const draw_state *s, uint4 source, uint4 under) {
  const uint4 sum = source * factor(s->source, source, under) +
                    under * factor(s->destination, source, under) + 128;
  const uint4 most = min(sum, (uint4)(0xff00));
  return (most + (most >> 8)) >> 8;
}

/* Weights of a triangle's first two corners at a pixel, in 24 fraction bits. */
static int2 weights(global const vx_triangle *t, uint x, uint y) {
  float edge[3];
  for (int k = 0; k != 3; ++k)
    edge[k] = (float)((long)((ulong)(uint)t->c_high[k] << 32 | t->c_low[k]) +
                      (long)t->a[k] * x + (long)t->b[k] * y);
  const float once = 1.0f / (edge[0] + edge[1] + edge[2]);
  return (int2)(fixed(edge[0] * once), fixed(edge[1] * once));
}

static uchar4 shaded(constant const draw_state *s, global const attributes *v,
                     int2 w, global const uchar4 *texels, uchar4 under) {
  uint4 color = 255;
  if (s->textured)
    color = sampled(s, texels, at(&v->of[U], w.x, w.y) >> 1,
                    at(&v->of[V], w.x, w.y) >> 1);
  if (!s->textured || s->modulated) {
    const int4 own = (int4)(at(&v->of[RED], w.x, w.y),
                            at(&v->of[RED + 1], w.x, w.y),
                            at(&v->of[RED + 2], w.x, w.y),
                            at(&v->of[RED + 3], w.x, w.y));
    color = as_uint4(own) * color >> 24;
  }
  if (s->blended)
    color = blended(s, color, convert_uint4(under));
  return convert_uchar4(color);
}

static bool passes(uint function, uint depth, uint stored) {
  const uint which = depth < stored ? 1 : depth == stored ? 2 : 4;
  return function & which;
}

/* What a tile of a draw has. */
typedef struct {
  constant const draw_state *s;
  global const vx_triangle *records;
  global const attributes *values;
  global const uchar4 *texels;
  global vx_visibility *depths;
  global uchar4 *picture;
} surface;

static void draw_fragment(const surface *f, uint triangle, uint x, uint y) {
  constant const draw_state *s = f->s;
  const uint pixel = y * s->width + x;
  const int2 w = weights(&f->records[triangle], x, y);
  if (s->depth_test) {
    const uint mask = (1 << DEPTH_BITS) - 1;
    const uint depth = at(&f->values[triangle].of[Z], w.x, w.y) & mask;
    if (!passes(s->depth_function, depth, (uint)f->depths[pixel].depth))
      return;
    if (s->depth_write)
      f->depths[pixel].depth = (float)depth;
  }
  f->picture[pixel] =
      shaded(s, &f->values[triangle], w, f->texels, f->picture[pixel]);
}

/* The triangles that meet a tile, in order. Returns how many. */
static uint list_tile(const surface *f, global uint *list, uint x, uint y) {
  uint count = 0;
  for (uint first = 0; first < f->s->triangles; first += LANES) {
    const uint i = first + get_local_id(0);
    uint meets = 0;
    if (i < f->s->triangles) {
      const uint low = f->records[i].first, high = f->records[i].last;
      meets = (low & 0xffff) < x + TILE && (high & 0xffff) >= x &&
              low >> 16 < y + TILE && high >> 16 >= y;
    }
    const uint place = count + sub_group_scan_exclusive_add(meets);
    if (meets)
      list[place] = i;
    count += sub_group_reduce_add(meets);
  }
  return count;
}

/* Takes the fragments that the unit hands over, 16 at a time in the order of
   triangles. Fragments of one pixel are taken in the order of the
   lanes. */
static void take_fragments(const surface *f, local uint *owner) {
  const uint lane = get_local_id(0);
  for (uint next = vr_grad_next(); next != 0; next = vr_grad_next()) {
    vr_index_set(VR_ITEM_PRIMITIVE);
    const uint triangle = vr_item();
    vr_index_set(VR_ITEM_PIXEL);
    const uint x = vr_item() & 0xffff, y = vr_item() >> 16;
    local uint *own = &owner[y % TILE * TILE + x % TILE];
    bool waits =
        lane < (next >> VR_GRAD_NEXT_COUNT_SHIFT & VR_GRAD_NEXT_COUNT_MASK);
    while (sub_group_any(waits)) {
      if (waits)
        atomic_min(own, lane);
      sub_group_barrier(CLK_LOCAL_MEM_FENCE);
      const bool is_first = waits && *own == lane;
      sub_group_barrier(CLK_LOCAL_MEM_FENCE);
      if (is_first) {
        draw_fragment(f, triangle, x, y);
        *own = LANES;
        waits = false;
      }
      sub_group_barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
    }
  }
}

/* Draws a tile, one a group of a warp. Without depth test and blending the last
   triangle of a pixel stays: the unit finds it, and each pixel is shaded once
   (`seen`). Else kernels test and blend fragments. The unit drops those whose
   triangle is behind what earlier draws left in `depths`.
   `lists` has `triangles` entries a tile. */
kernel __attribute__((reqd_work_group_size(16, 1, 1))) void
draw(constant const draw_state *s, global const vx_triangle *records,
     global const attributes *values, global const uchar4 *texels,
     global uint *lists, global vx_visibility *seen,
     global vx_visibility *depths, global uchar4 *picture,
     global uint *statuses) {
  local uint owner[TILE * TILE];
  const uint lane = get_local_id(0), tile = get_group_id(0);
  const uint tiles_x = (s->width + TILE - 1) / TILE;
  const uint x = tile % tiles_x * TILE, y = tile / tiles_x * TILE;
  const uint wide = min(TILE, s->width - x), high = min(TILE, s->height - y);
  const uint first = y * s->width + x;
  const surface f = {s, records, values, texels, depths, picture};
  global uint *list = lists + tile * s->triangles;
  const uint count = list_tile(&f, list, x, y);
  const bool hands_over = s->depth_test || s->blended;
  const bool nearer =
      s->depth_test && (s->depth_function == LESS || s->depth_function == LEQUAL);
  vx_raster_setup((uint)records, 0.0f, 0, s->width * sizeof(vx_visibility));
  vx_raster_triangles((nearer ? LEQUAL : ALWAYS) << VR_DEPTH_FUNCTION_SHIFT |
                          (uint)!hands_over << VR_DEPTH_WRITE_SHIFT |
                          (uint)nearer << VR_DEPTH_LOAD_SHIFT,
                      0.0f, hands_over);
  vx_raster_render((uint)list, count, x, y, wide, high,
                   (uint)((hands_over ? depths : seen) + first));
  if (hands_over) {
    for (uint i = lane; i < TILE * TILE; i += LANES)
      owner[i] = LANES;
    sub_group_barrier(CLK_LOCAL_MEM_FENCE);
    take_fragments(&f, owner);
  }
  const uint status = vr_wait();
  if (!hands_over && status == VR_OK)
    for (uint i = lane; i < wide * high; i += LANES) {
      const uint column = x + i % wide, row = y + i / wide;
      const uint triangle = seen[row * s->width + column].primitive;
      if (triangle != VR_NO_PRIMITIVE)
        draw_fragment(&f, triangle, column, row);
    }
  if (lane == 0)
    statuses[tile] = status;
}
