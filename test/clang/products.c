// LLVM's constraint elimination, which is left out, makes the comparison true (LLVM's issue 140481).
// RUN: vorion-clang -O2 %s -o %t.elf
// RUN: vorion-sim --set clusters=1,sockets_per_cluster=1,cores_per_socket=1 %t.elf
// REQUIRES: vorion-clang, vorion-link, vorion-sim
volatile int from = 1, sum, product;

int main() {
  int a = from, b = -5001001 * a + 5001000;
  while (b >= 5001001)
    b = a + 5001000;
  int c = -5001000 * b - 5001001;
  sum = b;
  product = c;
  return 5001000 * c >= b;
}
