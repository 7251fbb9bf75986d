/* The projection kernel of splat, compiled for one lane: work(0, 1) calls it as
   the one group there is. On the device it is launched as a kernel, on the same
   input. */
#include "bench.h"

extern const uint32_t project_view[], project_geometry[], project_sh[];
/* bench/isasim/run.py writes the numbers down: COUNT. */
static uint32_t records[COUNT * 12], depths[COUNT];
static uint64_t rectangles[COUNT];
static uint32_t seen[9], local[512];

void project(const void *view, const void *geometry, const void *sh,
             void *records, void *depths, void *rectangles, void *seen,
             uint32_t count, void *local);

/* OpenCL's, of the first work-item of a group of one. */
#define WORK_ITEM_FUNCTION(name, value)                                        \
  uint32_t name(uint32_t dimension) {                                          \
    (void)dimension;                                                           \
    return value;                                                              \
  }
WORK_ITEM_FUNCTION(_Z13get_global_idj, 0)
WORK_ITEM_FUNCTION(_Z12get_local_idj, 0)
WORK_ITEM_FUNCTION(_Z12get_group_idj, 0)
WORK_ITEM_FUNCTION(_Z14get_num_groupsj, 1)
void _Z7barrierj(uint32_t flags) { (void)flags; }

uint32_t work(uint32_t lane, uint32_t lanes) {
  (void)lane, (void)lanes;
  project(project_view, project_geometry, project_sh, records, depths,
          rectangles, seen, COUNT, local);
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
