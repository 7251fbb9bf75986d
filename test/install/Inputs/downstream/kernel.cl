kernel void square(global uint *out) {
  const uint i = get_global_id(0);
  out[i] = i * i;
}
