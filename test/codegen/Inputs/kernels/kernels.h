/* What a module of random kernels is written in, for two machines: the device,
   where the lanes of a warp run it together, and a plain rv32 Linux program,
   where a loop takes lane after lane from one barrier to the next.

   Values that live across barriers are in a `state` a lane. Between barriers a
   lane reads what others wrote before the last one and writes what nobody reads
   before the next: `theirs` and `mine` are two halves that change places. */

#ifdef __riscv_xvortex
#include <vorion.h>
#define LANE vx_thread_id()
#define EACH_LANE
#define STATES state only
#define S only
#define BARRIER vx_bar(0, 1)
/* Values of all lanes at once; only called where all lanes are. */
#define BALLOT(to, value) to = vx_vote_ballot(value)
#define ANY(to, value) to = vx_vote_any(value)
#define ALL(to, value) to = vx_vote_all(value)
/* The value of lane `LANE ^ with`, or the lane's own if there is none. */
#define EXCHANGE(to, value, with) to = vx_shfl_bfly(value, (with) | 31u << 6)
#else
typedef unsigned int uint;
enum { MAX_LANES = 16 };
static uint Lane, Lanes;
#define LANE Lane
#define EACH_LANE for (Lane = 0; Lane < Lanes; Lane++)
#define STATES state all[MAX_LANES]
#define S all[Lane]
#define BARRIER (void)0
#define COLLECT(to, value, start, step)                                        \
  do {                                                                         \
    uint result = (start), i;                                                  \
    uint values[MAX_LANES];                                                    \
    EACH_LANE values[Lane] = (value);                                          \
    for (i = 0; i < Lanes; i++)                                                \
      result = (step);                                                         \
    EACH_LANE to = result;                                                     \
  } while (0)
#define BALLOT(to, value)                                                      \
  COLLECT(to, value, 0, result | (uint)(values[i] != 0) << i)
#define ANY(to, value) COLLECT(to, value, 0, result | (values[i] != 0))
#define ALL(to, value) COLLECT(to, value, 1, result &(values[i] != 0))
#define EXCHANGE(to, value, with)                                              \
  do {                                                                         \
    uint values[MAX_LANES];                                                    \
    EACH_LANE values[Lane] = (value);                                          \
    EACH_LANE to = values[(Lane ^ (with)) < Lanes ? Lane ^ (with) : Lane];     \
  } while (0)
#endif

typedef unsigned char uchar;
typedef unsigned short ushort;
typedef unsigned long long ulong;
typedef uint uint4 __attribute__((ext_vector_type(4)));
typedef float float2 __attribute__((ext_vector_type(2)));
typedef struct {
  uint first;
  float second;
} pair;
typedef struct {
  ulong wide;
  uint words[4];
  uchar bytes[5];
} large;

#define NOINLINE __attribute__((noinline)) static
#define INLINE __attribute__((always_inline)) static inline
#define PLAIN static
#define UNUSED __attribute__((unused))

/* Never anything but 0. The compiler sees only that others may write it. */
uint impossible;
__attribute__((noreturn)) NOINLINE UNUSED void stay(void) {
  for (;;)
    ;
}

/* What a lane keeps across barriers and what is compared in the end. */
typedef struct {
  uint x, y, z, u, v, r;
  float f, g;
  ulong w;
  double d;
  uint a[4];
  ushort h[4];
  uchar b[8];
  pair p;
} state;

enum {
  OUT_WORDS = 32,
  HALF_WORDS = 32,
  SHARED_WORDS = 16,
  SHARED_START = 0x7f3c0ff1
};

/* One group of lanes in one kernel. */
typedef struct {
  uint *out;    /* OUT_WORDS for each lane of each group */
  uint *shared; /* SHARED_WORDS in global memory, for all groups: written by
                   atomics only */
  uint *mine,
      *theirs; /* in local memory: a word for each lane, then SHARED_WORDS */
  uint n, lanes, group;
} group;

static inline uint bits(float f) {
  union {
    float f;
    uint u;
  } both = {f};
  return f != f ? 0x7fc00000 : both.u;
}
static inline float float_of(uint x) {
  union {
    uint u;
    float f;
  } both = {x};
  return both.f != both.f ? 0.5f : both.f;
}
static inline ulong double_bits(double d) {
  union {
    double d;
    ulong u;
  } both = {d};
  return d != d ? 1 : both.u;
}
/* Conversions and divisions that C leaves undefined give something else. */
static inline int to_int(float f) {
  return f > -2e9f && f < 2e9f ? (int)f : 77;
}
static inline uint to_uint(float f) {
  return f > -0.9f && f < 4e9f ? (uint)f : 78;
}
static inline ulong to_ulong(float f) {
  return f > -9e18f && f < 9e18f ? (ulong)(long long)f : 79;
}
static inline int signed_div(int a, int b) {
  return b == 0 || b == -1 ? a : a / b;
}
static inline int signed_rem(int a, int b) {
  return b == 0 || b == -1 ? a : a % b;
}

NOINLINE UNUSED uint early(uint a, uint b) {
  if (a & 1)
    return a * b;
  while (b & 3)
    b++;
  return a ^ b;
}
NOINLINE UNUSED uint nested(uint a, uint b) {
  uint r = 0;
  for (uint i = 0; i < (a & 7); i++) {
    for (uint j = 0; j < (b & 7); j++) {
      if ((i ^ j) == (a & 3))
        goto next;
      if (j * i > 9)
        return r;
      r += i * j + 1;
    }
    r ^= a;
  next:;
  }
  return r;
}
NOINLINE UNUSED uint recursive(uint a, uint depth) {
  if (depth == 0)
    return a;
  return depth & 1 ? recursive(a * 3 + depth, depth - 1) ^ a
                   : recursive(a >> 1, depth - 1) + 5;
}
NOINLINE UNUSED float round_to(float x, uint how) {
  switch (how & 3) {
  case 0:
    return __builtin_floorf(x * 0.37f);
  case 1:
    return __builtin_ceilf(x * 0.61f);
  case 2:
    return __builtin_truncf(x * 1.9f);
  default:
    return __builtin_rintf(x * 0.5f);
  }
}
NOINLINE UNUSED double in_double(float x, uint y) {
  double d = (double)x * 1.25 + (int)y;
  return d < 0 ? d * d : y & 1 ? d / 3 : d - 0.5;
}
NOINLINE UNUSED pair turn(pair p, uint4 v) {
  if (v.x & 2)
    return (pair){v.y + p.first, p.second * 0.5f};
  for (uint i = 0; i < (v.z & 3); i++)
    p.first = p.first * 5 + v[i];
  return (pair){p.first ^ v.w, -p.second};
}
NOINLINE UNUSED large grow(large from, uint by) {
  for (uint i = 0; i < 4; i++) {
    if (from.words[i] > by)
      from.bytes[i] += (uchar)by;
    else
      from.wide += from.words[i] * (ulong)by;
    from.words[i] ^= by << i;
  }
  return from;
}
NOINLINE UNUSED uint4 weave(uint4 v, float2 f, uint how) {
  uint4 r = v.wzyx + (uint4)how;
  if (f.x < f.y)
    r = r * v;
  return how & 4 ? r ^ v : r;
}
NOINLINE UNUSED uint through_large(uint a, uint b) {
  large l = grow((large){a, {b, a ^ b, 7, a}, {1, 2, 3, 4, 5}}, b & 255);
  return (uint)l.wide + l.words[a & 3] + l.bytes[b % 5];
}
/* Any order of lanes gives the same product. */
static inline UNUSED void multiply_atomically(uint *word, uint by) {
  uint old = __atomic_load_n(word, 0);
  while (!__atomic_compare_exchange_n(word, &old, old * (by | 1), 0, 0, 0))
    ;
}

INLINE void begin_lane(state *s, const group *m) {
  *s = (state){.x = LANE * 7 + m->n,
               .y = (LANE ^ 5) + m->group * 3,
               .z = 3,
               .u = m->n,
               .v = m->n * 3};
  s->f = (float)LANE * 1.25f;
  s->g = (float)m->n - 4.75f;
  s->w = (ulong)LANE << 33 | 77;
  s->d = 0.1;
  for (uint i = 0; i < 4; i++)
    s->a[i] = s->h[i] = i * LANE;
  for (uint i = LANE; i < HALF_WORDS; i += m->lanes)
    m->mine[i] = m->theirs[i] = SHARED_START;
}
INLINE void end_lane(const state *s, const group *m) {
  uint *own = m->out + (m->group * m->lanes + LANE) * OUT_WORDS;
  uint *to = own + 8; /* own[0] to own[7] are the lane's memory while it runs */
  *to++ = s->x;
  *to++ = s->y;
  *to++ = s->z;
  *to++ = s->u;
  *to++ = s->v;
  *to++ = s->r;
  *to++ = bits(s->f);
  *to++ = bits(s->g);
  *to++ = (uint)s->w;
  *to++ = (uint)(s->w >> 32);
  *to++ = (uint)double_bits(s->d);
  *to++ = (uint)(double_bits(s->d) >> 32);
  for (uint i = 0; i < 4; i++)
    *to++ = s->a[i] ^ (uint)s->h[i] << 16 ^ s->b[i] ^ (uint)s->b[i + 4] << 8;
  *to++ = s->p.first;
  *to++ = bits(s->p.second);
  *to++ = m->mine[LANE] ^ m->theirs[LANE] << 1;
}
