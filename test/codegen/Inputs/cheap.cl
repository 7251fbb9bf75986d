kernel void by_constant(global uint *a, global int *b) {
  int i = get_global_id(0);
  a[i] = a[i] / 10 + a[i] % 7;
  b[i] = b[i] / 10;
}
kernel void by_power(global uint *a) {
  int i = get_global_id(0);
  a[i] = a[i] / 8 + a[i] % 16;
}
kernel void product(global int *a, global int *b) {
  int i = get_global_id(0);
  a[i] = mad24(a[i], b[i], 5);
}
kernel void whole(global int *a) {
  int i = get_global_id(0);
  a[i] = clamp(a[i], -3, 200);
}
kernel void natural(global uint *a) {
  int i = get_global_id(0);
  a[i] = clamp(a[i], 3u, 200u);
}
kernel void real(global float *a) {
  int i = get_global_id(0);
  a[i] = clamp(a[i], 0.25f, 0.75f);
}
