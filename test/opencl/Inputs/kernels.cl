#include "scale.h"

kernel void scale(global int *data, int n) {
  int i = get_global_id(0);
  if (i < n)
    data[i] *= SCALE;
}

kernel void reverse(global const int *in, global int *out, local int *t) {
  int l = get_local_id(0), n = get_local_size(0);
  t[l] = in[get_global_id(0)];
  barrier(CLK_LOCAL_MEM_FENCE);
  out[get_global_id(0)] = t[n - 1 - l];
}

kernel __attribute__((reqd_work_group_size(20, 1, 1))) void fixed(global int *out) {
  local int sum;
  if (get_local_id(0) == 0)
    sum = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  atomic_add(&sum, 1);
  barrier(CLK_LOCAL_MEM_FENCE);
  out[get_global_id(0)] = sum;
}
