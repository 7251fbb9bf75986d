kernel __attribute__((reqd_work_group_size(7, 1, 1))) void jumps(global uint *out, local uint *t, uint k) {
  uint l = get_local_id(0), w = l;
  if (l & 2)
    goto done;
  w = w * 3 + 1;
  if (t[0]) {
    w = 5;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
done:
  out[get_global_id(0)] = w + k;
}
