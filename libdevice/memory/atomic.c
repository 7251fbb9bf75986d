/* What the compiler calls for atomic objects of 64 bits in C, where an operator
   accesses them: its list for riscv32 ends at 32 bits. The machine has no lock,
   so larger ones trap. */

#include <stddef.h>
#include <stdint.h>

typedef uint64_t __attribute__((may_alias)) wide;

#define NAMED(NAME) __asm__("__atomic_" #NAME)

_Bool is_lock_free(size_t size, const volatile void *at) NAMED(is_lock_free);
void load(size_t size, const volatile void *at, void *to, int order)
    NAMED(load);
void store(size_t size, volatile void *at, const void *from, int order)
    NAMED(store);
void exchange(size_t size, volatile void *at, const void *from, void *to,
              int order) NAMED(exchange);
_Bool compare_exchange(size_t size, volatile void *at, void *expected,
                       const void *desired, int success, int failure)
    NAMED(compare_exchange);

static void require_wide(size_t size) {
  if (size != sizeof(wide))
    __builtin_trap();
}

_Bool is_lock_free(size_t size, const volatile void *at) {
  return (size == 1 || size == 2 || size == 4 || size == 8) &&
         (uintptr_t)at % size == 0;
}

void load(size_t size, const volatile void *at, void *to, int order) {
  (void)order; /* all are sequentially consistent */
  require_wide(size);
  *(wide *)to = __atomic_load_n((const volatile wide *)at, __ATOMIC_SEQ_CST);
}

void store(size_t size, volatile void *at, const void *from, int order) {
  (void)order;
  require_wide(size);
  __atomic_store_n((volatile wide *)at, *(const wide *)from, __ATOMIC_SEQ_CST);
}

void exchange(size_t size, volatile void *at, const void *from, void *to,
              int order) {
  (void)order;
  require_wide(size);
  *(wide *)to = __atomic_exchange_n((volatile wide *)at, *(const wide *)from,
                                    __ATOMIC_SEQ_CST);
}

_Bool compare_exchange(size_t size, volatile void *at, void *expected,
                       const void *desired, int success, int failure) {
  (void)success;
  (void)failure;
  require_wide(size);
  return __atomic_compare_exchange_n((volatile wide *)at, (wide *)expected,
                                     *(const wide *)desired, 0,
                                     __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST);
}
