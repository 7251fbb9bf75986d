kernel void twice(global const int *in, global int *out) {
  int i = get_global_id(0);
  int x = in[i];
  if (i % 3)
    out[i] = 2 * x;
}
