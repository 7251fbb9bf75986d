kernel void chain(global uint *out, uint n) {
  uint x = get_global_id(0);
  for (uint k = 0; k < n; ++k)
    x = x * 1664525u + 1013904223u;
  out[get_global_id(0)] = x;
}
