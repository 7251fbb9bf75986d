/* Which lane constructs a static variable of a function (C++ ABI, 3.3.3). The
   others wait for it: those of its own warp because the way around the
   construction ends where it ends, those of other warps here. */
#include <stdint.h>
#include <vorion.h>

struct guard {
  uint8_t is_constructed; /* what compiled code reads before it calls */
  uint32_t constructor;   /* a warp's number from 1 on, 0 if there is none */
};

/* 1 for the lane that is to construct the variable, else 0. */
int __cxa_guard_acquire(struct guard *guard) {
  const uint32_t own = 1 + vx_core_id() * vx_num_warps() + vx_warp_id();
  while (!__atomic_load_n(&guard->is_constructed, __ATOMIC_ACQUIRE)) {
    uint32_t constructor = 0;
    if (__atomic_compare_exchange_n(&guard->constructor, &constructor, own, 0,
                                    __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE))
      return 1;
    if (constructor == own)
      return 0;
  }
  return 0;
}

void __cxa_guard_release(struct guard *guard) {
  __atomic_store_n(&guard->is_constructed, 1, __ATOMIC_RELEASE);
}
