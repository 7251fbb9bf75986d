#include "vorion/support/HostMemory.h"

#include <sys/mman.h>
#include <unistd.h>

namespace vorion {

uint64_t hostMemory() {
  return static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

void releasePages(std::span<const std::byte> Done) {
  const auto Page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  // Bytes before the first whole page, and those after the last.
  const std::size_t Before = -reinterpret_cast<uintptr_t>(Done.data()) % Page;
  const std::size_t After =
      reinterpret_cast<uintptr_t>(Done.data() + Done.size()) % Page;
  if (Done.size() < Before + After + Page)
    return;
  const auto Whole = Done.subspan(Before, Done.size() - Before - After);
  // A host that keeps them loses nothing but memory.
  ::madvise(const_cast<std::byte *>(Whole.data()), Whole.size(), MADV_DONTNEED);
}

} // namespace vorion
