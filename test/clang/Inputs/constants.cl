// Constants that cost several instructions each.
kernel void scale(global float *x) {
  const size_t i = get_global_id(0);
  x[i] = (x[i] * 0.123456f + 0.654321f) * x[i] - 1.234567f;
}
