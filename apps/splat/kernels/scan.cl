// Exclusive prefix sum of `count` words in three steps: every work-item sums
// its stretch of `chunk` words, one work-item scans those sums, every work-item
// adds up its stretch from there. out[count] gets the total. Sums saturate, so
// that a total that does not fit is not taken for a small one.

__kernel void scan_sums(__global const uint *in, __global uint *sums,
                        uint count, uint chunk) {
  const uint item = get_global_id(0);
  const uint begin = min(item * chunk, count);
  const uint end = min(begin + chunk, count);
  uint sum = 0;
  for (uint i = begin; i < end; ++i)
    sum = add_sat(sum, in[i]);
  sums[item] = sum;
}

__kernel void scan_partials(__global uint *sums, uint count) {
  uint sum = 0;
  for (uint i = 0; i < count; ++i) {
    const uint value = sums[i];
    sums[i] = sum;
    sum = add_sat(sum, value);
  }
}

__kernel void scan_apply(__global const uint *in, __global const uint *sums,
                         __global uint *out, uint count, uint chunk) {
  const uint item = get_global_id(0);
  const uint begin = min(item * chunk, count);
  const uint end = min(begin + chunk, count);
  uint sum = sums[item];
  for (uint i = begin; i < end; ++i) {
    const uint value = in[i];
    out[i] = sum;
    sum = add_sat(sum, value);
  }
  if (begin < count && end == count)
    out[count] = sum;
}
