volatile int Which = 1;

int main(void) {
  static void *const places[] = {&&first, &&second};
  goto *places[Which];
first:
  return 1;
second:
  return 0;
}
