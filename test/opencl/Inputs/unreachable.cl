kernel void some(global int *out, int end) {
  const int i = get_global_id(0);
  out[i] = i;
  if (i >= end) {
    // A volatile access, or the optimiser would know that nobody comes here.
    *(volatile global int *)out = 1;
    __builtin_unreachable();
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  out[i] += 1;
}

kernel void every(global int *out) {
  out[get_global_id(0)] = 1;
  __builtin_unreachable();
}
