#include "translate/HostCode.h"

#include <cstring>
#include <sys/mman.h>

namespace vorion::isasim::translate {

/// What begins a line of the host's cache. Sanitizers look at the bytes in
/// front of a function, so there are some in front of the first.
static constexpr size_t Line = 64;

HostCode::HostCode(size_t Bytes) {
  void *const At = mmap(nullptr, Bytes, PROT_NONE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (At == MAP_FAILED)
    return;
  Base = static_cast<std::byte *>(At);
  All = Bytes;
  Used = Line;
}

HostCode::~HostCode() {
  if (Base)
    munmap(Base, All);
}

std::byte *HostCode::add(std::span<const uint8_t> Code) {
  if (!Base || Code.size() > All - Used ||
      mprotect(Base, All, PROT_READ | PROT_WRITE) != 0)
    return nullptr;
  std::byte *const At = Base + Used;
  std::memcpy(At, Code.data(), Code.size());
  if (mprotect(Base, All, PROT_READ | PROT_EXEC) != 0)
    return nullptr;
  Used += (Code.size() + Line - 1) / Line * Line;
  if (Used > All)
    Used = All;
  return At;
}

} // namespace vorion::isasim::translate
