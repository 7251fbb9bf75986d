#include <vorion.h>

// What groups of one core would share if warps did not keep them apart: local
// memory, their own and given, what lives across barriers, stacks, printf.
constant int powers[4] = {1, 10, 100, 1000};
global int seven = 7;

int pick(const int *from, int n) { return from[n % 8]; }

kernel void apart(global int *out, global uint *met, local int *given) {
  local int own[64];
  const int item = get_local_id(0), items = get_local_size(0);
  const int group = get_group_id(0);
  int kept[8];
  for (int i = 0; i < 8; ++i)
    kept[i] = group * seven + i + item;
  own[item] = group * 100 + item;
  given[item] = group + powers[item % 4];
  barrier(CLK_LOCAL_MEM_FENCE);
  // Long enough for the other warps to be in the middle of theirs.
  int sum = 0;
  for (int round = 0; round < 20; ++round) {
    const int other = (item + round) % items;
    sum += own[other] + given[other] + pick(kept, round + item);
    barrier(CLK_LOCAL_MEM_FENCE);
    own[item] += 1;
    if (item % 16 == 0)
      atomic_inc(met);
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (item == 0 && group % 32 == 0)
    printf("group %d of %d\n", group, (int)get_num_groups(0));
  out[get_global_id(0)] = sum + work_group_reduce_add(item == 3 ? group : 0);
}

kernel void places(global uint *out) {
  out[get_global_id(0)] = vx_warp_id() << 8 | vx_core_id();
}
