/* Destructors that are virtual come with a function that also frees the object,
   whether or not the program calls it. There is no memory to be freed, since
   the library allocates none: a program with its own operator new has its own
   operator delete, too. */
#include <stddef.h>

namespace std {
enum class align_val_t : size_t {};
}

#define REPLACEABLE __attribute__((weak))

REPLACEABLE void operator delete(void *) noexcept { __builtin_trap(); }
REPLACEABLE void operator delete(void *object, size_t) noexcept {
  operator delete(object);
}
REPLACEABLE void operator delete[](void *objects) noexcept {
  operator delete(objects);
}
REPLACEABLE void operator delete[](void *objects, size_t) noexcept {
  operator delete[](objects);
}
REPLACEABLE void operator delete(void *, std::align_val_t) noexcept {
  __builtin_trap();
}
REPLACEABLE void operator delete(void *object, size_t,
                                 std::align_val_t alignment) noexcept {
  operator delete(object, alignment);
}
REPLACEABLE void operator delete[](void *objects,
                                   std::align_val_t alignment) noexcept {
  operator delete(objects, alignment);
}
REPLACEABLE void operator delete[](void *objects, size_t,
                                   std::align_val_t alignment) noexcept {
  operator delete[](objects, alignment);
}
