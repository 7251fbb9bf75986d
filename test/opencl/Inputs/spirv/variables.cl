/// Variables of program scope; for OpenCL C 2.0.
global int count = 40;
static global int zero;
global int *global to = &count;

kernel void add(global int *out) {
  static global int own = 3;
  ++zero;
  out[0] = atomic_add(to, 1);
  out[1] = zero + own++;
}

kernel void look(global int *out) {
  out[0] = count;
  out[1] = zero;
}
