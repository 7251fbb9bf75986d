kernel void meet(global uint *p, local uint *t, uint k) {
  uint l = get_local_id(0), n = get_local_size(0);
  if (l & 1) {
    if (p[l] == k)
      while (1)
        ;
    if (p[l] == k + 1)
      __builtin_trap();
    t[l] = 5;
  } else
    t[l] = 3;
  barrier(CLK_LOCAL_MEM_FENCE);
  p[l] = t[(l + 1) % n];
}
kernel void next(global uint *p) { p[get_global_id(0)] = 2; }
