// Kernels that fill private memory of about N words in several ways. Each
// work-item writes 1 more than the number of words that it found changed. n is
// N, which the compiler must not know; every STEPth word is used.

#define FILL(a, n, key)                                                        \
  for (int i = 0; i < (n); i += STEP)                                          \
  (a)[i] = i * 3 + (key)
#define COUNT(a, n, key, bad)                                                  \
  for (int i = 0; i < (n); i += STEP)                                          \
  (bad) += (a)[i] != i * 3 + (key)

kernel void plain(global int *o, int n) {
  int a[N], bad = 1;
  const int g = get_global_id(0);
  FILL(a, n, g);
  COUNT(a, n, g, bad);
  o[g] = bad;
}

__attribute__((noinline)) int inner(int key, int n) {
  int a[N / 2], bad = 0;
  FILL(a, n, key);
  COUNT(a, n, key, bad);
  return bad;
}
__attribute__((noinline)) int outer(int key, int n) {
  int a[N / 4], bad = 0;
  FILL(a, n / 2, key);
  bad += inner(key + 7, n);
  COUNT(a, n / 2, key, bad);
  return bad;
}
kernel void called(global int *o, int n) {
  int a[N / 4], bad = 1;
  const int g = get_global_id(0);
  FILL(a, n / 4, g);
  bad += outer(g + 1000, n / 2) + inner(g - 1000, n / 2);
  COUNT(a, n / 4, g, bad);
  o[g] = bad;
}

kernel void several(global int *o, int n) {
  int a[N / 4], bad = 1;
  short b[N / 2];
  uchar c[N];
  const int g = get_global_id(0);
  FILL(a, n / 4, g);
  for (int i = 0; i < n / 2; i += STEP)
    b[i] = i + g;
  for (int i = 0; i < n; i += STEP)
    c[i] = i ^ g;
  for (int i = 0; i < n / 2; i += STEP)
    bad += b[i] != (short)(i + g);
  for (int i = 0; i < n; i += STEP)
    bad += c[i] != (uchar)(i ^ g);
  COUNT(a, n / 4, g, bad);
  o[g] = bad;
}

// Lanes are apart, and at different words.
kernel void apart(global int *o, int n) {
  int a[N], bad = 1;
  const int g = get_global_id(0), from = g % 5 * STEP;
  for (int i = from; i < n; i += STEP)
    a[i] = i * 5 + g;
  if (g % 3 != 1)
    for (int i = from; i < n; i += STEP)
      a[i] -= g;
  for (int i = from; i < n; i += STEP)
    bad += a[i] != i * 5 + (g % 3 != 1 ? 0 : g);
  o[g] = bad;
}

// The array outlives a barrier, and the group may have many passes.
kernel void kept(global int *o, int n) {
  int a[N / 8], bad = 1;
  const int g = get_global_id(0);
  FILL(a, n / 8, g);
  barrier(CLK_LOCAL_MEM_FENCE);
  COUNT(a, n / 8, g, bad);
  barrier(CLK_LOCAL_MEM_FENCE);
  COUNT(a, n / 8, g, bad);
  o[g] = bad;
}

kernel void printed(global int *o, int n) {
  int a[N], bad = 1;
  const int g = get_global_id(0);
  FILL(a, n, g);
  if (g == 3)
    printf("item %d of %d words\n", g, n);
  COUNT(a, n, g, bad);
  o[g] = bad;
}

// What recursion takes depends on the run: n is how deep it goes.
__attribute__((noinline)) int deeper(int key, int n) {
  int a[16], bad = 0;
  for (int i = 0; i < 16; i++)
    a[(i + n) & 15] = i + key;
  if (n > 0)
    bad += deeper(key + 1, n - 1);
  for (int i = 0; i < 16; i++)
    bad += a[(i + n) & 15] != i + key;
  return bad;
}
kernel void recursive(global int *o, int n) {
  int a[N], bad = 1;
  const int g = get_global_id(0);
  FILL(a, N, g);
  bad += deeper(g, n);
  COUNT(a, N, g, bad);
  o[g] = bad;
}
