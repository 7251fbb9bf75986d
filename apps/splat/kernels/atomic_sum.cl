// OpenCL C 1.2 has no atomic sum of floats: whoever finds another value than the
// one added to adds again.
#pragma once

static void atomic_sum(volatile __global float *to, float value) {
  volatile __global uint *word = (volatile __global uint *)to;
  uint expected = *word;
  for (;;) {
    const uint found = atomic_cmpxchg(
        word, expected, as_uint(as_float(expected) + value));
    if (found == expected)
      return;
    expected = found;
  }
}
