/* What a generic pointer points to. A kernel's private variables are on the
   stack of their lane, or in the launch's context if they live across a barrier
   (docs/abi.md). */

#include <vorion_abi.h>

uint32_t vx_mscratch(void) __asm("vorion.vx_mscratch")
    __attribute__((convergent, nomerge, nothrow));
uint32_t vx_stack_size(void) __asm("vorion.vx_stack_size")
    __attribute__((convergent, nomerge, nothrow));
uint32_t vx_num_cores(void) __asm("vorion.vx_num_cores")
    __attribute__((convergent, nomerge, nothrow));

/* The number of the stack that holds an address, from the top. */
static uint32_t stack_of(uint32_t address) {
  return (VX_STACK_TOP - 1 - address) / vx_stack_size();
}

typedef enum { Global, Local, Private } space;

static space space_of(const void *pointer) {
  const uint32_t address = (uint32_t)pointer;
  char here;
  if (address >= VX_LOCAL_BASE)
    return Local;
  if (stack_of(address) == stack_of((uint32_t)&here))
    return Private;
  const vx_launch *launch = (const vx_launch *)vx_mscratch();
  const uint32_t context_bytes =
      launch->context_stride * vx_num_cores() * launch->warps;
  return address - launch->context < context_bytes ? Private : Global;
}

static void *if_in(space wanted, void *pointer) {
  return space_of(pointer) == wanted ? pointer : 0;
}

void *__to_global(void *pointer) { return if_in(Global, pointer); }

void *__to_local(void *pointer) { return if_in(Local, pointer); }

void *__to_private(void *pointer) { return if_in(Private, pointer); }

/* CLK_LOCAL_MEM_FENCE or CLK_GLOBAL_MEM_FENCE. */
uint32_t vorion_fence_of(const void *pointer) {
  return space_of(pointer) == Local ? 1 : 2;
}
