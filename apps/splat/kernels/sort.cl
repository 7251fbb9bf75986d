// One pass of a stable least-significant-digit radix sort of (key, value)
// pairs. Each group owns one stretch of `chunk` pairs:
//   sort_count    histogram[group][digit] of every group's stretch
//   sort_offsets  sums each digit's column of that, from the first group on
//   sort_scatter  every pair to its digit's next place
// The first pass may drop pairs and make the values: those named "kept" leave
// out keys whose highest bit is set, take the lowest `shift` bits and `base`
// off the others, and number the pairs.
//
// Pairs are scattered, and a store of a word to a line of its own is a message
// as long as the line. So those named "words" put what is left of a key, its
// higher digits, above the value into one word, as soon as both fit: the digits
// that were sorted by are not needed any more. What the last pass leaves of a
// key is nothing, and such a word is the value. With one word for a pair, where
// it took two, sorting guitar by depth takes 45 % fewer cycles on prototype.
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

// What a pass reads and writes: constants of its kernel.
typedef struct {
  bool kept;     // keys alone, of which some are dropped
  bool words_in; // words instead of pairs
  bool words_out;
} form;

// Where the digit of a pass is.
typedef struct {
  uint shift, bits; // bits below it in a key or a word, its own
  uint base;        // taken off the keys, which only "kept" ones have
  uint value_bits;  // words: of a value
} place_of_digit;

// The digit in the lowest bits, and what is left of the key above it. `in` is a
// key or a word.
static uint shifted(uint in, place_of_digit at) {
  return (in >> at.shift) - at.base;
}

static uint digit_of(uint shifted_key, place_of_digit at) {
  return shifted_key & ((1u << at.bits) - 1);
}

static stretch own_stretch(uint count, uint chunk) {
  const uint begin = min((uint)get_group_id(0) * chunk, count);
  return (stretch){begin, min(begin + chunk, count)};
}

static void count_digits(__global const uint *keys, __global uint *histogram,
                         uint count, uint chunk, form f, place_of_digit at,
                         __local uint *bins) {
  const uint lane = get_local_id(0);
  const uint lanes = get_local_size(0);
  const uint digits = 1u << at.bits;
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
      if (!f.kept || KEPT(key[k]))
        atomic_inc(&bins[digit_of(shifted(key[k], at), at)]);
  }
  for (uint i = line + lane; i < own.end; i += lanes) {
    const uint key = keys[i];
    if (!f.kept || KEPT(key))
      atomic_inc(&bins[digit_of(shifted(key, at), at)]);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint d = lane; d < digits; d += lanes)
    histogram[get_group_id(0) * digits + d] = bins[d];
}

// Of pairs and of words, whose digit lies above the value.
__kernel void sort_count(__global const uint *keys, __global uint *histogram,
                         uint count, uint chunk, uint shift, uint digit_bits) {
  __local uint bins[BINS];
  count_digits(keys, histogram, count, chunk, (form){false, false, false},
               (place_of_digit){shift, digit_bits, 0, 0}, bins);
}

__kernel void sort_count_kept(__global const uint *keys,
                              __global uint *histogram, uint count, uint chunk,
                              uint shift, uint digit_bits, uint base) {
  __local uint bins[BINS];
  count_digits(keys, histogram, count, chunk, (form){true, false, false},
               (place_of_digit){shift, digit_bits, base, 0}, bins);
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

// sums[digit] = how many come before it. The digits are summed by lanes, each a
// share of its own, which are apart by an odd number of words so that lanes
// meet in no bank.
static void sum_totals(__global const uint *totals, uint digits,
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
}

// places[digit] = the group's first place for it.
static void first_places(__global const uint *histogram,
                         __global const uint *totals, uint digits,
                         __local workspace *w) {
  sum_totals(totals, digits, w);
  const uint lane = get_local_id(0);
  const uint lanes = get_local_size(0);
  for (uint d = lane; d < digits; d += lanes)
    w->places[d] = w->sums[d] + histogram[get_group_id(0) * digits + d];
  barrier(CLK_LOCAL_MEM_FENCE);
}

// Where pairs and words are. Of words, the arrays of keys are not there.
typedef struct {
  __global const uint *keys, *values;
  __global uint *keys_out, *values_out;
} arrays;

// Of pair `i`: the value.
static uint value_of(const arrays *a, uint in, uint i, form f,
                     place_of_digit at) {
  return f.kept       ? i
         : f.words_in ? in & ((1u << at.value_bits) - 1)
                      : a->values[i];
}

static void store(const arrays *a, uint place, uint in, uint value, form f,
                  place_of_digit at) {
  const uint key = shifted(in, at);
  if (f.words_out) {
    a->values_out[place] = key >> at.bits << at.value_bits | value;
  } else {
    a->keys_out[place] = f.kept ? key : in;
    a->values_out[place] = value;
  }
}

static void scatter(arrays a, __global const uint *histogram,
                    __global const uint *totals, uint count, uint chunk, form f,
                    place_of_digit at, __local workspace *w) {
  first_places(histogram, totals, 1u << at.bits, w);
  const uint lane = get_local_id(0);
  const uint lanes = get_local_size(0);
  __global const uint *in = f.words_in ? a.values : a.keys;
  const stretch own = own_stretch(count, chunk);
  // All lanes leave the first loop together, which keeps pairs in order.
  uint line = own.begin;
  for (; line + BATCH * lanes <= own.end; line += BATCH * lanes) {
    const uint i = line + lane;
    uint key[BATCH], value[BATCH];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      key[k] = in[i + k * lanes];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      value[k] = value_of(&a, key[k], i + k * lanes, f, at);
    uint place[BATCH];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      if (!f.kept || KEPT(key[k]))
        place[k] = atomic_inc(&w->places[digit_of(shifted(key[k], at), at)]);
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      if (!f.kept || KEPT(key[k]))
        store(&a, place[k], key[k], value[k], f, at);
  }
  for (uint i = line + lane; i < own.end; i += lanes) {
    const uint key = in[i];
    if (!f.kept || KEPT(key))
      store(&a, atomic_inc(&w->places[digit_of(shifted(key, at), at)]), key,
            value_of(&a, key, i, f, at), f, at);
  }
}

__kernel void sort_scatter(__global const uint *keys,
                           __global const uint *values,
                           __global const uint *histogram,
                           __global const uint *totals, __global uint *keys_out,
                           __global uint *values_out, uint count, uint chunk,
                           uint shift, uint digit_bits) {
  __local workspace w;
  scatter((arrays){keys, values, keys_out, values_out}, histogram, totals,
          count, chunk, (form){false, false, false},
          (place_of_digit){shift, digit_bits, 0, 0}, &w);
}

// From pairs to words.
__kernel void sort_scatter_to_words(__global const uint *keys,
                                    __global const uint *values,
                                    __global const uint *histogram,
                                    __global const uint *totals,
                                    __global uint *words_out, uint count,
                                    uint chunk, uint shift, uint digit_bits,
                                    uint value_bits) {
  __local workspace w;
  scatter((arrays){keys, values, 0, words_out}, histogram, totals, count, chunk,
          (form){false, false, true},
          (place_of_digit){shift, digit_bits, 0, value_bits}, &w);
}

__kernel void sort_scatter_words(__global const uint *words,
                                 __global const uint *histogram,
                                 __global const uint *totals,
                                 __global uint *words_out, uint count,
                                 uint chunk, uint digit_bits, uint value_bits) {
  __local workspace w;
  scatter((arrays){0, words, 0, words_out}, histogram, totals, count, chunk,
          (form){false, true, true},
          (place_of_digit){value_bits, digit_bits, 0, value_bits}, &w);
}

__kernel void
sort_scatter_kept(__global const uint *keys, __global const uint *histogram,
                  __global const uint *totals, __global uint *keys_out,
                  __global uint *values_out, uint count, uint chunk, uint shift,
                  uint digit_bits, uint base) {
  __local workspace w;
  scatter((arrays){keys, 0, keys_out, values_out}, histogram, totals, count,
          chunk, (form){true, false, false},
          (place_of_digit){shift, digit_bits, base, 0}, &w);
}

__kernel void sort_scatter_kept_to_words(
    __global const uint *keys, __global const uint *histogram,
    __global const uint *totals, __global uint *words_out, uint count,
    uint chunk, uint shift, uint digit_bits, uint base, uint value_bits) {
  __local workspace w;
  scatter((arrays){keys, 0, 0, words_out}, histogram, totals, count, chunk,
          (form){true, false, true},
          (place_of_digit){shift, digit_bits, base, value_bits}, &w);
}

// Where the values of each digit begin and end. One group.
__kernel void sort_ranges(__global const uint *totals, __global uint2 *ranges,
                          uint digits) {
  __local workspace w;
  sum_totals(totals, digits, &w);
  for (uint d = get_local_id(0); d < digits; d += get_local_size(0))
    ranges[d] = (uint2)(w.sums[d], w.sums[d] + totals[d]);
}
