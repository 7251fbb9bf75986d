// Triangles on the machine: lanes set a fan up, the rasterizer draws it as
// depth and primitive, and hands it over as fragments. Each pixel of the tile
// is covered once, and by the triangle that the host's code says.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf && vorion-sim %t.elf | FileCheck %s
// RUN: vorion-clang -O0 %s -o %t.O0.elf && vorion-sim %t.O0.elf | FileCheck %s
// RUN: vorion-sim %t.elf --time --stats %t.json > %t.timed && FileCheck %s < %t.timed
// CHECK: set up 9, drawn 4096, wrong 0, depth 0.5 to 0.5
// CHECK: fragments 4096, twice 0, batches 256, status 0
// CHECK: behind: fragments 0, status 0

// The set-up is OpenCL C, too.
// RUN: clang-19 -x cl -cl-std=CL1.2 -Wall -Wextra -Werror -Wno-unused-function -fsyntax-only -target riscv32 -I %include -I %root/libdevice/include %root/libdevice/include/vorion_triangles.h
#include <vorion_raster.h>
#include <vorion_triangles.h>

int printf(const char *, ...);

enum { Rim = 9, Side = 64, Pixels = Side * Side };

/* Rasterizers see global memory only. */
static vx_triangle *const triangles = (vx_triangle *)VX_GLOBAL_BASE;
static uint *const list = (uint *)(VX_GLOBAL_BASE + 0x1000);
static vx_visibility *const pixels =
    (vx_visibility *)(VX_GLOBAL_BASE + 0x10000);
static unsigned char times[Pixels];

/* Corners about the tile, clockwise; the hub lies on a sample. */
static const int rim_x[Rim] = {-500,  9000, 17000, 17000, 17000,
                               16800, 7000, -900,  -500};
static const int rim_y[Rim] = {-300,  -700,  -300,  5000, 12000,
                               17000, 16700, 16900, 8000};
static const int hub = 30 * 256 + 128;

static void set_up(uint i) {
  const uint next = (i + 1) % Rim;
  const int x[] = {hub, rim_x[i], rim_x[next]},
            y[] = {hub, rim_y[i], rim_y[next]};
  const float depth[] = {0.5f, 0.5f, 0.5f};
  list[i] = i;
  vx_triangle_setup(&triangles[i], x, y, depth, 100 + i, Side, Side);
}

/* Whether all edges of triangle i hold at a pixel. */
static int holds(uint i, int column, int row) {
  for (int edge = 0; edge != 3; ++edge) {
    const vx_triangle *t = &triangles[i];
    const long long c = (long long)t->c_high[edge] << 32 | t->c_low[edge];
    if (c + (long long)t->a[edge] * column + (long long)t->b[edge] * row < 0)
      return 0;
  }
  return 1;
}

static void draw(uint fragments, uint load) {
  vx_raster_setup((uint)triangles, 0, 0, Side * sizeof(vx_visibility));
  vx_raster_triangles(4u << VR_DEPTH_FUNCTION_SHIFT |
                          1u << VR_DEPTH_WRITE_SHIFT |
                          load << VR_DEPTH_LOAD_SHIFT,
                      0, fragments);
  vx_raster_render((uint)list, Rim, 0, 0, Side, Side, (uint)pixels);
}

static void check_pixels(void) {
  int drawn = 0, wrong = 0;
  float least = 9, most = 0;
  for (int p = 0; p != Pixels; ++p) {
    const vx_visibility v = pixels[p];
    drawn += v.primitive != VR_NO_PRIMITIVE;
    wrong += v.primitive - 100 >= Rim ||
             !holds(v.primitive - 100, p % Side, p / Side);
    least = v.depth < least ? v.depth : least;
    most = v.depth > most ? v.depth : most;
  }
  printf("set up %d, drawn %d, wrong %d, depth %.4g to %.4g\n", Rim, drawn,
         wrong, (double)least, (double)most);
}

int main(void) {
  const uint lane = vx_thread_id();
  if (vx_core_id() != 0)
    return 0;
  if (lane < Rim)
    set_up(lane);
  draw(0, 0);
  const uint drawn = vr_wait();
  if (lane == 0 && drawn == 0)
    check_pixels();

  draw(1, 0);
  uint count = 0, batches = 0, next;
  while ((next = vr_grad_next()) != 0) {
    vr_index_set(VR_ITEM_PIXEL);
    const uint pixel = vr_item();
    if (lane < (next & VR_GRAD_NEXT_COUNT_MASK))
      ++times[(pixel >> 16) * Side + (pixel & 0xffff)];
    count += next & VR_GRAD_NEXT_COUNT_MASK;
    ++batches;
  }
  const uint status = vr_wait();
  if (lane == 0) {
    int twice = 0;
    for (int p = 0; p != Pixels; ++p)
      twice += times[p] != 1;
    printf("fragments %u, twice %d, batches %u, status %u\n", count, twice,
           batches, status);
  }

  /* Nothing is in front of itself. */
  draw(1, 1);
  count = 0;
  while ((next = vr_grad_next()) != 0)
    count += next & VR_GRAD_NEXT_COUNT_MASK;
  const uint again = vr_wait();
  if (lane == 0)
    printf("behind: fragments %u, status %u\n", count, again);
  return 0;
}
