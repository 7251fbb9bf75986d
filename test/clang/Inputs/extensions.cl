// What Zicond, Zba, Zbb and Zbs are for.
kernel void choose(global uint *a, uint n) {
  const uint i = get_global_id(0);
  const uint x = i * n;
  const uint y = min(x, 77u) | (1u << (i & 31));
  a[i] = x % 3 == 0 ? y : x;
}
