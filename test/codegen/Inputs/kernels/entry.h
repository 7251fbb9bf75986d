/* Included at the end of a module: calls run_kernels for each group. */
#ifdef __riscv_xvortex
typedef struct {
  uint *out, n, lanes, *local;
} arguments;

void _pocl_kernel_all_workgroup(const arguments *a, const vx_launch *l, uint x,
                                uint y, uint z) {
  run_kernels(a->out, a->local, a->n, a->lanes, x);
}

static const vx_kernel_arg argument_list[] = {
    {(uint) "out", VX_ARG_GLOBAL, 0, 4},
    {(uint) "n", VX_ARG_VALUE, 4, 4},
    {(uint) "lanes", VX_ARG_VALUE, 8, 4},
    {(uint) "local", VX_ARG_LOCAL, 12, 4}};
__attribute__((section("vorion_kernels"),
               used)) static const vx_kernel kernel = {
    (uint) "all",
    (uint)_pocl_kernel_all_workgroup,
    (uint)argument_list,
    4,
    16,
    0,
    0,
    {0, 0, 0}};
#else
#include "linux.h"

int main(void) {
  static uint out[KERNELS * KERNEL_WORDS], local[2 * HALF_WORDS];
  /* What the device gets at run time is not known when this is compiled either.
   */
  volatile uint n = ARGUMENT, lanes = LANES;
  Lanes = lanes;
  for (uint kernel = 1; kernel <= KERNELS; kernel++)
    for (uint i = 1; i <= SHARED_WORDS; i++)
      out[kernel * KERNEL_WORDS - i] = SHARED_START;
  for (uint number = 0; number < GROUPS; number++)
    run_kernels(out, local, n, lanes, number);
  return write_all(out, sizeof out);
}
#endif
