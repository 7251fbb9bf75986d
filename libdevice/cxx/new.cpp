/* Arrays come from the operator new of single objects, which is the program's
   own: the library allocates no memory. */
#include <stddef.h>

namespace std {
enum class align_val_t : size_t {};
}

__attribute__((weak)) void *operator new[](size_t size) {
  return operator new(size);
}
__attribute__((weak)) void *operator new[](size_t size,
                                           std::align_val_t alignment) {
  return operator new(size, alignment);
}
