/* The projection kernel of splat, compiled for one lane: work(0, 1) calls it
   for each Gaussian. On the device it is launched as a kernel, on the same
   input. */
#include "bench.h"

extern const uint32_t project_view[], project_geometry[], project_sh[];
/* bench/isasim/run.py writes the numbers down: COUNT. */
static uint32_t records[COUNT * 12], depths[COUNT], order[COUNT];
static uint64_t rectangles[COUNT];
/* Volatile: to the compiler, get_global_id is a constant that nothing changes.
 */
static volatile uint32_t item;

void project(const void *view, const void *geometry, const void *sh,
             void *records, void *depths, void *order, void *rectangles,
             uint32_t count);

/* OpenCL's get_global_id. */
uint32_t _Z13get_global_idj(uint32_t dimension) {
  (void)dimension;
  return item;
}

uint32_t work(uint32_t lane, uint32_t lanes) {
  for (item = lane; item < COUNT; item += lanes)
    project(project_view, project_geometry, project_sh, records, depths, order,
            rectangles, COUNT);
  uint32_t sum = 0;
  for (uint32_t n = 0; n < COUNT; ++n)
    sum = sum * 31 + depths[n];
  return sum;
}

__asm__(".section .rodata\n"
        ".balign 64\n"
        "project_view: .incbin \"view.bin\"\n"
        ".balign 64\n"
        "project_geometry: .incbin \"geometry.bin\"\n"
        ".balign 64\n"
        "project_sh: .incbin \"sh.bin\"\n"
        ".text\n");
