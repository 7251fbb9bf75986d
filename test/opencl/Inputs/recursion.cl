// Functions that call themselves and each other, also where lanes part.
uint odd(uint n);
uint even(uint n) { return n == 0 ? 1 : odd(n - 1); }
uint odd(uint n) { return n == 0 ? 0 : even(n - 1); }
uint factorial(uint n) { return n < 2 ? 1 : n * factorial(n - 1); }
uint fibonacci(uint n) {
  return n < 2 ? n : fibonacci(n - 1) + fibonacci(n - 2);
}

kernel void recursion(global uint *out) {
  const uint i = get_global_id(0);
  out[i] = fibonacci(i % 12) + 1000 * factorial(i % 8) + 1000000 * even(i);
}
