kernel void in_rounds(global int *out, volatile local int *more, int n) {
  int i = get_global_id(0);
  if (i >= n)
    return;
  while (*more) {
    barrier(CLK_LOCAL_MEM_FENCE);
    out[i] += i;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
}

// What is read is told to those that have returned.
kernel void told(global int *out, global const int *lengths, int n) {
  int i = get_global_id(0);
  if (i >= n)
    return;
  for (int k = 0; k < lengths[get_group_id(0)]; k++) {
    out[i] += i;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
}
