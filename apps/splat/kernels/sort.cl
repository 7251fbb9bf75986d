// One pass of a stable least-significant-digit radix sort of (key, value)
// pairs. Each group owns one stretch of `chunk` pairs:
//   sort_count    histogram[group][digit] of every group's stretch
//   sort_offsets  sums each digit's column of that, from the first group on
//   sort_scatter  every pair to its digit's next place
// The first pass may drop pairs and make the values: sort_count_kept and
// sort_scatter_kept leave out keys whose highest bit is set, take the lowest
// `shift` bits and `base` off the others, and number the pairs.
//
// A group is one warp, so that what neighbouring lanes read lies in one line
// and a digit has one open line a core. Its lanes take neighbouring pairs, and
// a digit's next place is an atomic addition of all of them at once, which a
// Vorion core does in lane order (docs/abi.md): that keeps the sort stable. On
// any other device a group must be a single work-item (Sorter.cpp).

#define BINS 1024
#define MOST_LANES 16
#define KEPT(key) ((key) < 0x80000000U)
// Loads in flight of each work-item.
#define BATCH 4

typedef struct {
  uint begin, end; // pairs
} stretch;

// A key as it is sorted, and its digit of a pass.
static uint reduced(uint key, bool first, uint shift, uint base) {
  return first ? (key >> shift) - base : key;
}
static uint digit_of(uint key, bool first, uint shift, uint mask) {
  return (first ? key : key >> shift) & mask;
}

static stretch own_stretch(uint count, uint chunk) {
  const uint begin = min((uint)get_group_id(0) * chunk, count);
  return (stretch){begin, min(begin + chunk, count)};
}

static void count_digits(__global const uint *keys, __global uint *histogram,
                         uint count, uint chunk, uint shift, uint digits,
                         bool first, uint base, __local uint *bins) {
  const uint lane = get_local_id(0);
  const uint lanes = get_local_size(0);
  const uint mask = digits - 1;
  for (uint d = lane; d < digits; d += lanes)
    bins[d] = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  const stretch own = own_stretch(count, chunk);
  // All lanes leave the first loop together, which keeps pairs in order.
  uint line = own.begin;
  for (; line + BATCH * lanes <= own.end; line += BATCH * lanes) {
    const uint i = line + lane;
    uint key[BATCH];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      key[k] = keys[i + k * lanes];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      if (!first || KEPT(key[k]))
        atomic_inc(&bins[digit_of(reduced(key[k], first, shift, base), first,
                                  shift, mask)]);
  }
  for (uint i = line + lane; i < own.end; i += lanes) {
    const uint key = keys[i];
    if (!first || KEPT(key))
      atomic_inc(&bins[digit_of(reduced(key, first, shift, base), first, shift,
                                mask)]);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint d = lane; d < digits; d += lanes)
    histogram[get_group_id(0) * digits + d] = bins[d];
}

__kernel void sort_count(__global const uint *keys, __global uint *histogram,
                         uint count, uint chunk, uint shift, uint digits) {
  __local uint bins[BINS];
  count_digits(keys, histogram, count, chunk, shift, digits, false, 0, bins);
}

__kernel void sort_count_kept(__global const uint *keys,
                              __global uint *histogram, uint count, uint chunk,
                              uint shift, uint digits, uint base) {
  __local uint bins[BINS];
  count_digits(keys, histogram, count, chunk, shift, digits, true, base, bins);
}

// A work-item a digit; totals[digit] gets all of it.
__kernel void sort_offsets(__global uint *histogram, __global uint *totals,
                           uint groups, uint digits) {
  const uint digit = get_global_id(0);
  uint sum = 0;
  for (uint group = 0; group < groups; ++group) {
    const uint own = histogram[group * digits + digit];
    histogram[group * digits + digit] = sum;
    sum += own;
  }
  totals[digit] = sum;
}

typedef struct {
  uint places[BINS];
  uint sums[BINS + MOST_LANES];
  uint shares[MOST_LANES];
} workspace;

// places[digit] = the group's first place for it. The digits are summed by
// lanes, each a share of its own, which are apart by an odd number of words so
// that lanes meet in no bank.
static void first_places(__global const uint *histogram,
                         __global const uint *totals, uint digits,
                         __local workspace *w) {
  const uint lane = get_local_id(0);
  const uint lanes = get_local_size(0);
  const uint share = (digits + lanes - 1) / lanes | 1;
  for (uint d = lane; d < digits; d += lanes)
    w->sums[d] = totals[d];
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint begin = min(lane * share, digits);
  const uint end = min(begin + share, digits);
  uint sum = 0;
  for (uint d = begin; d < end; ++d) {
    const uint own = w->sums[d];
    w->sums[d] = sum;
    sum += own;
  }
  w->shares[lane] = sum;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint before = 0;
  for (uint other = 0; other < lanes; ++other)
    before += other < lane ? w->shares[other] : 0;
  for (uint d = begin; d < end; ++d)
    w->sums[d] += before;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint d = lane; d < digits; d += lanes)
    w->places[d] = w->sums[d] + histogram[get_group_id(0) * digits + d];
  barrier(CLK_LOCAL_MEM_FENCE);
}

static void scatter(__global const uint *keys, __global const uint *values,
                    __global const uint *histogram, __global const uint *totals,
                    __global uint *keys_out, __global uint *values_out,
                    uint count, uint chunk, uint shift, uint digits, bool first,
                    uint base, __local workspace *w) {
  first_places(histogram, totals, digits, w);
  const uint lane = get_local_id(0);
  const uint lanes = get_local_size(0);
  const uint mask = digits - 1;
  const stretch own = own_stretch(count, chunk);
  // All lanes leave the first loop together, which keeps pairs in order.
  uint line = own.begin;
  for (; line + BATCH * lanes <= own.end; line += BATCH * lanes) {
    const uint i = line + lane;
    uint key[BATCH], value[BATCH];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      key[k] = keys[i + k * lanes];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      value[k] = first ? i + k * lanes : values[i + k * lanes];
    uint place[BATCH];
    uint own_key[BATCH];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      own_key[k] = reduced(key[k], first, shift, base);
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      if (!first || KEPT(key[k]))
        place[k] =
            atomic_inc(&w->places[digit_of(own_key[k], first, shift, mask)]);
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      if (!first || KEPT(key[k])) {
        keys_out[place[k]] = own_key[k];
        values_out[place[k]] = value[k];
      }
  }
  for (uint i = line + lane; i < own.end; i += lanes) {
    const uint key = keys[i];
    if (!first || KEPT(key)) {
      const uint own_key = reduced(key, first, shift, base);
      const uint place =
          atomic_inc(&w->places[digit_of(own_key, first, shift, mask)]);
      keys_out[place] = own_key;
      values_out[place] = first ? i : values[i];
    }
  }
}

__kernel void sort_scatter(__global const uint *keys,
                           __global const uint *values,
                           __global const uint *histogram,
                           __global const uint *totals, __global uint *keys_out,
                           __global uint *values_out, uint count, uint chunk,
                           uint shift, uint digits) {
  __local workspace w;
  scatter(keys, values, histogram, totals, keys_out, values_out, count, chunk,
          shift, digits, false, 0, &w);
}

__kernel void
sort_scatter_kept(__global const uint *keys, __global const uint *histogram,
                  __global const uint *totals, __global uint *keys_out,
                  __global uint *values_out, uint count, uint chunk, uint shift,
                  uint digits, uint base) {
  __local workspace w;
  scatter(keys, keys, histogram, totals, keys_out, values_out, count, chunk,
          shift, digits, true, base, &w);
}
