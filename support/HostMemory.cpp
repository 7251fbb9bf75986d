#include "vorion/support/HostMemory.h"

#include <unistd.h>

namespace vorion {

uint64_t hostMemory() {
  return static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

} // namespace vorion
