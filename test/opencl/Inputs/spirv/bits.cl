// Functions that are instructions of SPIR-V's extensions for bits and dot products.
kernel void bits(global uint *out, global const uint *in, local uint *t) {
  const int i = get_global_id(0);
  const uint x = in[i], y = in[i + 1];
  const char4 a = as_char4(x), b = as_char4(y);
  const uchar4 c = as_uchar4(x), d = as_uchar4(y);
  uint sum = dot(a, b) * 3 + dot(c, d) * 5 + dot(c, b) * 7 + dot(a, d) * 11;
  sum += dot_acc_sat(a, b, INT_MAX - 99) ^ dot_acc_sat(c, d, UINT_MAX - 9999);
  sum ^= dot_acc_sat(c, b, INT_MIN + 99) + dot_acc_sat(a, d, (int)y);
  sum += dot_4x8packed_us_int(x, y) + dot_acc_sat_4x8packed_uu_uint(x, y, y);
  sum ^= bit_reverse(x) + as_uint(bit_reverse(b));
  sum += bitfield_insert(x, y, i % 16, i % 17) ^ bitfield_extract_unsigned(x, i % 16, i % 17);
  out[i] = sum + as_uint(bitfield_extract_signed(a, i % 4, i % 5));
}
