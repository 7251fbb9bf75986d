typedef struct {
  uint a;
  float b[2];
  ushort c;
  uchar d;
} record;

__kernel void by_value(__global uint *out, char first, record r) {
  out[get_global_id(0)] = first + r.a + (uint)r.b[1] + r.c + r.d;
}
