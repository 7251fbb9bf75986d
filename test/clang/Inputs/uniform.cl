kernel void one(global int *o) {
  o[0] = get_group_id(0);
}
kernel void difference(global float *o, float a, float b) {
  float s = a + b;
  float d = s - a;
  o[get_global_id(0)] = d;
}
