// Three mistakes: scattered loads into a private array, which does not fit into
// registers; a division by a variable in a loop; a branch that lanes part at.
kernel void slow(global const float *in, global float *out, int width,
                 int steps, float limit) {
  int i = get_global_id(0);
  float recent[16];
  for (int k = 0; k < 16; ++k)
    recent[k] = in[i * 16 + k];
  float sum = 0;
  for (int s = 0; s < steps; ++s)
    sum += recent[(i + s) % width];
  if (in[i] > limit)
    for (int s = 0; s < 8; ++s)
      out[i] += in[s] * sum;
  else
    out[i] = sum;
}
