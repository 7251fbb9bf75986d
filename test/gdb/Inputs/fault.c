// A store to page 0.
__attribute__((noinline)) void poke(volatile int *where) { // traps
  *where = 1;
}

int main(void) {
  poke((volatile int *)4);
  return 0;
}
