/* A filter of 3 x 3 on a picture of 32 x 32; pixels outside are left out, in
   branches that some lanes take. */
#include "kernel.h"

enum { SIZE = 32 };
RESULT(float, 1024);

int main(void) {
  const uint lane = vx_thread_id();
  FOR_WARPS(base, SIZE * SIZE) {
    const int x = (int)(base % SIZE + lane), y = (int)(base / SIZE);
    const float *weight = ones + SIZE * SIZE;
    float sum = 0;
#pragma nounroll
    for (int dy = -1; dy <= 1; ++dy)
#pragma nounroll
      for (int dx = -1; dx <= 1; ++dx, ++weight)
        if (x + dx >= 0 && x + dx < SIZE && y + dy >= 0 && y + dy < SIZE)
          sum = __builtin_fmaf(*weight, ones[(y + dy) * SIZE + x + dx], sum);
    result[base + lane] = sum;
  }
  return 0;
}
