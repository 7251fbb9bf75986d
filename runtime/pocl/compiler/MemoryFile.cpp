#include "MemoryFile.h"

#include <array>
#include <cerrno>
#include <sys/mman.h>
#include <unistd.h>

namespace vorion {

MemoryFile::MemoryFile(std::string_view Contents)
    : Descriptor(memfd_create("vorion", MFD_CLOEXEC)),
      Problem(Descriptor < 0 ? errno : 0) {
  while (Problem == 0 && !Contents.empty()) {
    const ssize_t Written = write(Descriptor, Contents.data(), Contents.size());
    if (Written > 0)
      Contents.remove_prefix(static_cast<size_t>(Written));
    else if (Written < 0 && errno != EINTR)
      Problem = errno;
  }
}

MemoryFile::~MemoryFile() { close(Descriptor); }

std::string MemoryFile::path() const {
  return "/proc/self/fd/" + std::to_string(Descriptor);
}

std::string MemoryFile::contents() const {
  std::string All;
  std::array<char, 65536> Part{};
  for (ssize_t Got = 0; (Got = pread(Descriptor, Part.data(), Part.size(),
                                     static_cast<off_t>(All.size()))) > 0;)
    All.append(Part.data(), static_cast<size_t>(Got));
  return All;
}

} // namespace vorion
