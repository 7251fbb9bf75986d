// One pass of a stable least-significant-digit radix sort of (key, value)
// pairs. Each work-item owns one stretch of `chunk` pairs and counts it alone,
// so the result depends on no order of arrival and needs no atomics:
//   sort_count    histogram[digit][item] of every work-item's stretch
//   (exclusive scan of the histogram: scan.cl)
//   sort_scatter  every pair to its digit's next place
// The counters of the 16 work-items of a group are interleaved in local memory
// (digit * 16 + lane), one bank a lane. BINS is the most digits of a pass.

#define BINS 256
#define LANES 16

__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
sort_count(__global const uint *keys, __global uint *histogram, uint count,
           uint chunk, uint shift, uint digits) {
  __local uint bins[BINS * LANES];
  const uint lane = get_local_id(0);
  const uint item = get_global_id(0);
  const uint items = get_global_size(0);
  for (uint d = 0; d < digits; ++d)
    bins[d * LANES + lane] = 0;
  const uint begin = min(item * chunk, count);
  const uint end = min(begin + chunk, count);
  for (uint i = begin; i < end; ++i)
    ++bins[(keys[i] >> shift & (digits - 1)) * LANES + lane];
  for (uint d = 0; d < digits; ++d)
    histogram[d * items + item] = bins[d * LANES + lane];
}

__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
sort_scatter(__global const uint *keys, __global const uint *values,
             __global const uint *offsets, __global uint *keys_out,
             __global uint *values_out, uint count, uint chunk, uint shift,
             uint digits) {
  __local uint places[BINS * LANES];
  const uint lane = get_local_id(0);
  const uint item = get_global_id(0);
  const uint items = get_global_size(0);
  for (uint d = 0; d < digits; ++d)
    places[d * LANES + lane] = offsets[d * items + item];
  const uint begin = min(item * chunk, count);
  const uint end = min(begin + chunk, count);
  for (uint i = begin; i < end; ++i) {
    const uint key = keys[i];
    const uint bin = (key >> shift & (digits - 1)) * LANES + lane;
    const uint place = places[bin];
    places[bin] = place + 1;
    keys_out[place] = key;
    values_out[place] = values[i];
  }
}
