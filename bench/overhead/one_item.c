/* Runs a kernel as plain scalar code, one work-item after the other on a single
   lane, and counts its instructions alone. Work-items of a group take turns at
   barriers, each on a stack of its own. Compiled with KERNEL_NAME, ARGUMENTS
   (rows of vx_kernel_arg), NUM_ARGUMENTS, ARGUMENTS_BYTES, LOCAL_BYTES and
   STRIDE, the distance between the groups that are run. */
#include <vorion.h>
#include <vorion_print.h>

enum { MAX_ITEMS = 1024, STACK_WORDS = 2048 };

/* What PoCL's kernel library reads. */
uint _local_id_x, _local_id_y, _local_id_z, _group_id_x, _group_id_y,
    _group_id_z, _local_size_x, _local_size_y, _local_size_z, _num_groups_x,
    _num_groups_y, _num_groups_z, _global_offset_x, _global_offset_y,
    _global_offset_z, _work_dim;

/* The kernel, called with its packed arguments. */
void one_item(const void *args);
static void (*body)(const void *) = one_item;

static const void *packed;
static uint *saved_stack, *item_stack[MAX_ITEMS];
static uint stacks[MAX_ITEMS][STACK_WORDS];
static uint current, finished[MAX_ITEMS], counted, yields, items;

/* Keeps ra and s0 to s11 and fs0 to fs11 on this stack, whose address goes to
 *from, and goes on with the stack at to. */
void swap_stacks(uint **from, uint *to);
__asm__(".globl swap_stacks\n"
        "swap_stacks:\n"
        "  addi sp, sp, -112\n"
        "  sw ra, 0(sp)\n  sw s0, 4(sp)\n  sw s1, 8(sp)\n  sw s2, 12(sp)\n"
        "  sw s3, 16(sp)\n  sw s4, 20(sp)\n  sw s5, 24(sp)\n  sw s6, 28(sp)\n"
        "  sw s7, 32(sp)\n  sw s8, 36(sp)\n  sw s9, 40(sp)\n  sw s10, 44(sp)\n"
        "  sw s11, 48(sp)\n  fsw fs0, 52(sp)\n  fsw fs1, 56(sp)\n"
        "  fsw fs2, 60(sp)\n  fsw fs3, 64(sp)\n  fsw fs4, 68(sp)\n"
        "  fsw fs5, 72(sp)\n  fsw fs6, 76(sp)\n  fsw fs7, 80(sp)\n"
        "  fsw fs8, 84(sp)\n  fsw fs9, 88(sp)\n  fsw fs10, 92(sp)\n"
        "  fsw fs11, 96(sp)\n"
        "  sw sp, 0(a0)\n  mv sp, a1\n"
        "  lw ra, 0(sp)\n  lw s0, 4(sp)\n  lw s1, 8(sp)\n  lw s2, 12(sp)\n"
        "  lw s3, 16(sp)\n  lw s4, 20(sp)\n  lw s5, 24(sp)\n  lw s6, 28(sp)\n"
        "  lw s7, 32(sp)\n  lw s8, 36(sp)\n  lw s9, 40(sp)\n  lw s10, 44(sp)\n"
        "  lw s11, 48(sp)\n  flw fs0, 52(sp)\n  flw fs1, 56(sp)\n"
        "  flw fs2, 60(sp)\n  flw fs3, 64(sp)\n  flw fs4, 68(sp)\n"
        "  flw fs5, 72(sp)\n  flw fs6, 76(sp)\n  flw fs7, 80(sp)\n"
        "  flw fs8, 84(sp)\n  flw fs9, 88(sp)\n  flw fs10, 92(sp)\n"
        "  flw fs11, 96(sp)\n"
        "  addi sp, sp, 112\n  ret\n");

/* PoCL's barrier, as its library calls it. */
__attribute__((noinline)) void barrier_of_item(void) __asm__("pocl.barrier");
void barrier_of_item(void) {
  ++yields;
  swap_stacks(&item_stack[current], saved_stack);
}

static void run_item(void) {
  body(packed);
  finished[current] = 1;
  swap_stacks(&item_stack[current], saved_stack);
}

static void empty(const void *args) { (void)args; }
static void one_barrier(const void *args) {
  (void)args;
  barrier_of_item();
}

static inline uint now(void) {
  uint count;
  __asm__ volatile("csrr %0, cycle" : "=r"(count)::"memory");
  return count;
}

static void run_group(uint count) {
  for (uint i = 0; i < count; ++i) {
    item_stack[i] = &stacks[i][STACK_WORDS - 32];
    item_stack[i][0] = (uint)run_item;
    finished[i] = 0;
  }
  for (uint left = count; left;) {
    for (current = 0; current < count; ++current) {
      if (finished[current])
        continue;
      const uint plane = _local_size_x * _local_size_y;
      _local_id_x = current % plane % _local_size_x;
      _local_id_y = current % plane / _local_size_x;
      _local_id_z = current / plane;
      const uint start = now();
      swap_stacks(&saved_stack, item_stack[current]);
      counted += now() - start;
      left -= finished[current];
    }
  }
}

/* Instructions that run_group counts for one item of a body. */
static uint cost_of(void (*of)(const void *)) {
  body = of;
  counted = 0;
  run_group(1);
  return counted;
}

static void group(const void *args, const vx_launch *launch, uint gx, uint gy,
                  uint gz) {
  const uint linear =
      (gz * launch->num_groups[1] + gy) * launch->num_groups[0] + gx;
  const uint total =
      launch->num_groups[0] * launch->num_groups[1] * launch->num_groups[2];
  _local_size_x = launch->local_size[0];
  _local_size_y = launch->local_size[1];
  _local_size_z = launch->local_size[2];
  _num_groups_x = launch->num_groups[0];
  _num_groups_y = launch->num_groups[1];
  _num_groups_z = launch->num_groups[2];
  _global_offset_x = launch->global_offset[0];
  _global_offset_y = launch->global_offset[1];
  _global_offset_z = launch->global_offset[2];
  _work_dim = launch->work_dim;
  _group_id_x = gx;
  _group_id_y = gy;
  _group_id_z = gz;
  packed = args;
  static uint sum, entry, barrier;
  if (linear == 0) {
    entry = cost_of(empty);
    barrier = cost_of(one_barrier) - entry;
    body = one_item;
    yields = 0;
  }
  if (linear % STRIDE == 0) {
    const uint count = _local_size_x * _local_size_y * _local_size_z;
    counted = 0;
    run_group(count);
    items += count;
    sum += counted - count * entry;
  }
  if (linear + 1 == total)
    printf("items %u instructions %u\n", items, sum - yields * barrier);
}

static const vx_kernel_arg arguments[] = {ARGUMENTS};
__attribute__((section("vorion_kernels"),
               used)) static const vx_kernel kernel = {
    (uint)KERNEL_NAME, (uint)group, (uint)arguments, NUM_ARGUMENTS,
    ARGUMENTS_BYTES,   0,           LOCAL_BYTES,     {0, 0, 0}};
