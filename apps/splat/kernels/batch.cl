// What the views of one iteration give, added in the views' order: one after
// the other, so that it is the same bits wherever each view was rendered.

// The first view's gradients replace what was there; after the last one `scale`
// makes the mean of the sum (1 before).
__kernel void batch_add(__global float *sums, __global const float *gradients,
                        uint count, uint first, float scale) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const float sum = first ? gradients[i] : sums[i] + gradients[i];
  sums[i] = sum * scale;
}
