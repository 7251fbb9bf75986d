// Accesses to private, local and global memory, alone and spread over lines.
kernel void sums(global const int *in, global int *out, int width) {
  local int tile[16];
  int own[8];
  int i = get_global_id(0);
  for (int k = 0; k < 8; ++k)
    own[k] = in[(k * width + i * 5) & 63];
  tile[i & 15] = own[i & 7];
  barrier(CLK_LOCAL_MEM_FENCE);
  out[i] = own[tile[15 - (i & 15)] & 7];
}
