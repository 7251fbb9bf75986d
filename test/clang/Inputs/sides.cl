kernel void sides(global int *all, local int *shared, int n) {
  int i = get_local_id(0);
  if (all[i] > 0) {
    shared[i] = all[i + 1];
    for (int k = 0; k < n; k++) {
      barrier(CLK_LOCAL_MEM_FENCE);
      shared[i] += shared[(i + 1) % 16];
    }
  } else {
    shared[i] = 3;
    for (int k = 0; k < n; k++) {
      barrier(CLK_LOCAL_MEM_FENCE);
      shared[i] ^= shared[(i + 2) % 16];
    }
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  all[i] = shared[i];
}

kernel void __attribute__((reqd_work_group_size(256, 1, 1)))
scaled(global const float *a, global float *b, float x) {
  uint i = get_global_id(0);
  b[i] = a[i] * x + b[i];
}
