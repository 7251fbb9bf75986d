/* Where formatted text goes: into the launch's print buffer, or without a
   launch block (a program with main) to the console. */

#include "output.h"

#include <vorion.h>
#include <vorion_print.h>

void vx_put_console(char c) {
  *(volatile uint *)VX_IO_CONSOLE = (unsigned char)c;
}

/* The console takes what a warp stores lane by lane, so texts of several lanes
   would be shuffled: one lane writes at a time. */
static int print_to_console(enum vx_dialect dialect, const char *format,
                            va_list list, uint *count) {
  int result = 0;
  for (uint lane = 0; lane < vx_num_threads(); ++lane) {
    if (lane == vx_thread_id()) {
      struct vx_text text = {.console = 1};
      result = vx_format(&text, dialect, format, list);
      *count = text.count;
    }
  }
  return result;
}

static int print_to_buffer(const vx_launch *launch, enum vx_dialect dialect,
                           const char *format, va_list list, uint *count) {
  /* Measured first, so that one atomic add gives the text a place of its own.
   */
  struct vx_text text = {.count = 0};
  const int result = vx_format(&text, dialect, format, list);
  *count = text.count;
  vx_print *const print = (vx_print *)launch->print_buffer;
  const uint at =
      __atomic_fetch_add(&print->used, text.count, __ATOMIC_RELAXED);
  const uint capacity = launch->print_capacity;
  if (at < capacity) {
    char *const buffer = (char *)(print + 1);
    text = (struct vx_text){.at = buffer + at, .end = buffer + capacity};
    vx_format(&text, dialect, format, list);
  }
  /* Not all of it fits: an error of this call, whose text is cut off. */
  return at >= capacity || *count > capacity - at ? -1 : result;
}

int vx_vprint(enum vx_dialect dialect, const char *format, va_list list) {
  const vx_launch *const launch = (const vx_launch *)vx_mscratch();
  uint count = 0;
  const int result =
      launch ? print_to_buffer(launch, dialect, format, list, &count)
             : print_to_console(dialect, format, list, &count);
  return result ? -1 : (int)count;
}

int vx_vprintf_opencl(const char *format, va_list list) {
  return vx_vprint(VX_DIALECT_OPENCL, format, list) < 0 ? -1 : 0;
}
