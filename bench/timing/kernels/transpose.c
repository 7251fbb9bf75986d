/* Transposes a matrix of 64 x 64: the lanes' stores are in 16 lines. */
#include "kernel.h"

enum { SIZE = 64 };
RESULT(float, 4096);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, SIZE * SIZE) {
    const uint row = base / SIZE, column = base % SIZE + lane;
    result[column * SIZE + row] = ones[base + lane];
  }
  return 0;
}
