// Kernels in which a loop of 100 rounds is reached along several paths.
float work(float x) {
  for (int i = 0; i < 100; ++i)
    x = x * 1.5f - 1.0f / (x + 2.0f);
  return x;
}

#define KERNEL(name, ...)                                                      \
  kernel void name(global float *out, global const volatile int *in) {         \
    const int i = get_global_id(0), k = in[i];                                 \
    float x = i;                                                               \
    __VA_ARGS__                                                                \
    out[i] = x;                                                                \
  }

KERNEL(once, x = work(x);)
KERNEL(either, if (k < 5 || in[k] > 9) x = work(x);)
KERNEL(both, if (k < 12 && in[k] > 3) x = 1; else x = work(x);)
KERNEL(default_case, switch (k) {
  case 3: x = 1; break;
  case 7: x = 2; break;
  case 9: x = in[3]; break;
  default: x = work(x);
})
KERNEL(fall_through, switch (k & 3) {
  case 0: x += in[k];
  case 1: x = work(x); break;
  case 2: x = 7;
})
KERNEL(jump, if (k > 11) goto end; x += in[k]; if (in[k] < 4) goto end; x = 3;
       goto out; end: x = work(x); out:;)
KERNEL(early_return, if (k > 4) { x = 3; if (in[k] & 1) { out[i] = 9; return; } }
       x = work(x);)
KERNEL(from_loops, for (int a = 0; a < 4; ++a) {
  for (int b = 0; b < 4; ++b) {
    if (k == 4 * a + b && k < 12) goto found;
    if (in[k] < b) break;
  }
  if (in[k] == 12 + a) goto found;
}
goto missed; found: x = work(x); missed:;)
KERNEL(in_loop, for (int a = 0; a < 2; ++a) {
  if (k & 2) { if (in[k] & 4) continue; x += 1; if (in[k] & 8) break; }
  x = work(x);
})
