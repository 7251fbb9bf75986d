// Lane i leaves the loop after i turns.
kernel void leave(global int *o) {
  int i = get_local_id(0);
  int s = 0;
  for (int k = 0; k < i; k++)
    s += o[k];
  if (i & 1)
    s += 10;
  else
    s += 20;
  o[i] = s;
}
