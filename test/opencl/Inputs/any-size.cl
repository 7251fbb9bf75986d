// A work-item notes its ids at the place that its group and they give.
kernel void ids(global uint *out) {
  const size_t at = get_global_id(0) +
                    get_global_size(0) * (get_global_id(1) + get_global_size(1) * get_global_id(2));
  out[at] = get_local_id(0) | get_local_id(1) << 10 | get_local_id(2) << 20;
}

// As ids, with the ids of a second loop over passes.
kernel void ids_behind(global uint *out, local uint *counts) {
  if (get_local_id(0) + get_local_id(1) + get_local_id(2) == 0)
    *counts = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  atomic_inc(counts);
  barrier(CLK_LOCAL_MEM_FENCE);
  const size_t items = get_local_size(0) * get_local_size(1) * get_local_size(2);
  const size_t at = get_global_id(0) +
                    get_global_size(0) * (get_global_id(1) + get_global_size(1) * get_global_id(2));
  out[at] = *counts == items
                ? get_local_id(0) | get_local_id(1) << 10 | get_local_id(2) << 20
                : ~0u;
}
