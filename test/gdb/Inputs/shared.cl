// Each lane leaves the square of its number where its neighbour reads it.
kernel void neighbours(global int *o) {
  local int squares[16];
  int i = get_local_id(0);
  squares[i] = i * i;
  barrier(CLK_LOCAL_MEM_FENCE);
  o[i] = squares[(i + 1) & 15];
}
