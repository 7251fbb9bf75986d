kernel void square(global uint *out) {
  const uint i = get_global_id(0);
  out[i] = i * i;
}

// Work without loads, whose instructions need none of the last ones.
kernel void turns(global int *out) {
  int a = get_global_id(0), b = a + 1, c = a + 2, d = a + 3;
  for (int n = 0; n != 200; ++n) {
    a = a * 5 + n;
    b = b * 3 + n;
    c ^= c << 3;
    d += d >> 1;
  }
  out[get_global_id(0)] = a + b + c + d;
}
