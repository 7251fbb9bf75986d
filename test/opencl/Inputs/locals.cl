int twice(int x) {
  int doubled = 2 * x;
  return doubled;
}
kernel void locals(global int *out, int add) {
  int id = get_global_id(0);
  float half_id = id * 0.5f;
  int table[3] = {id, id + 1, id + 2};
  int sum = 0;
  for (int i = 0; i < 3; i++)
    sum += table[i];
  out[id] = twice(sum) + add + (int)half_id;
}
