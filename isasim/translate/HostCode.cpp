#include "translate/HostCode.h"

#include <cstring>
#include <sys/mman.h>
#include <unistd.h>

namespace vorion::isasim::translate {

/// What begins a line of the host's cache. Sanitizers look at the bytes in
/// front of a function, so each piece has some in front of it.
static constexpr size_t Line = 64;

HostCode::HostCode(size_t Bytes) {
  void *const At = mmap(nullptr, Bytes, PROT_NONE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (At == MAP_FAILED)
    return;
  Base = static_cast<std::byte *>(At);
  All = Bytes;
}

HostCode::~HostCode() {
  if (Base)
    munmap(Base, All);
}

std::byte *HostCode::add(std::span<const uint8_t> Code) {
  // Pages of its own: what is there already stays as it is, whatever fails.
  static const auto Page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  const size_t Bytes = (Line + Code.size() + Page - 1) / Page * Page;
  std::byte *const From = Base + Used;
  if (!Base || Bytes > All - Used ||
      mprotect(From, Bytes, PROT_READ | PROT_WRITE) != 0)
    return nullptr;
  std::memcpy(From + Line, Code.data(), Code.size());
  if (mprotect(From, Bytes, PROT_READ | PROT_EXEC) != 0)
    return nullptr;
  Used += Bytes;
  return From + Line;
}

} // namespace vorion::isasim::translate
