// Every lane adds up squares; the test stops in it.
unsigned results[16];

__attribute__((noinline)) unsigned square(unsigned x) { // broken at
  return x * x;
}

int main(void) {
  unsigned sum = 0;
  for (unsigned i = 0; i < 3; ++i)
    sum += square(i + 1);
  results[3] = sum;
  return 0;
}
