// A group of 64 work-items runs in four passes. In the first three kernels the
// work-items of one pass go another way between two barriers than those of the
// others.

// All leave the loop in its last round, some by the break: legal.
kernel void leave_apart(global uint *out, local uint *t, uint k) {
  uint l = get_local_id(0), r = l;
  for (uint i = 0; i < 3; i++) {
    if (k & 1) {
      t[l] = r;
      barrier(CLK_LOCAL_MEM_FENCE);
      r += t[(l + 1) % get_local_size(0)];
      barrier(CLK_LOCAL_MEM_FENCE);
    }
    if (i == 2) {
      if (l < 16)
        break;
      r += 7;
    }
  }
  out[get_global_id(0)] = r;
}

// Nobody reaches the barrier, and some go round more often: legal.
kernel void rounds_apart(global uint *out, local uint *t, uint k) {
  uint l = get_local_id(0), r = l, i = 0;
  do {
    if (k == 99) {
      t[l] = r;
      barrier(CLK_LOCAL_MEM_FENCE);
      r += t[(l + 1) % get_local_size(0)];
    }
    r += i + 3;
  } while (++i < l / 16 + 1);
  out[get_global_id(0)] = r;
}

// Only the first pass comes to the first barrier, and all to the second: not legal.
kernel void some(global uint *out, local uint *t, uint k) {
  uint l = get_local_id(0), r = l;
  out[get_global_id(0)] = k;
  if (l < 16) {
    t[l] = r;
    barrier(CLK_LOCAL_MEM_FENCE);
    out[get_global_id(0)] = r + t[15 - l];
  }
  barrier(CLK_GLOBAL_MEM_FENCE);
  out[get_global_id(0)] += out[0];
}

// The group goes three rounds, which only the values of a buffer show: legal,
// and no pass parts.
kernel void same_rounds(global uint *out, local uint *t, uint k) {
  uint l = get_local_id(0), r = l;
  out[get_global_id(0)] = k - 4;
  for (uint i = 0; i < out[get_global_id(0)]; i++) {
    t[l] = r;
    barrier(CLK_LOCAL_MEM_FENCE);
    r += t[(l + 1) % get_local_size(0)];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  out[get_global_id(0)] = r;
}
