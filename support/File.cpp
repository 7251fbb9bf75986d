#include "vorion/support/File.h"

#include "Descriptor.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace vorion {
namespace {

Error cannot(const std::string &Path, const char *Do, int Cause) {
  return {Path, fmt::format("cannot {}: {}, expected a readable file", Do,
                            std::strerror(Cause))};
}

uint64_t memoryOfMachine() {
  return static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Reads up to \p Size bytes; the number of them, or nothing with errno set.
std::optional<std::size_t> readSome(int From, std::byte *To, std::size_t Size) {
  for (;;) {
    const ssize_t Got = ::read(From, To, Size);
    if (Got >= 0)
      return static_cast<std::size_t>(Got);
    if (errno != EINTR)
      return std::nullopt;
  }
}

} // namespace

Expected<std::vector<std::byte>> readFile(const std::string &Path,
                                          uint64_t Most) {
  const Descriptor File(::open(Path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat Info{};
  if (File.number() < 0 || ::fstat(File.number(), &Info) != 0)
    return cannot(Path, "open", errno);
  // Files of /proc call themselves regular and empty.
  const bool SaysSize = S_ISREG(Info.st_mode) && Info.st_size > 0;
  if (SaysSize) {
    Most = std::min(Most, memoryOfMachine());
    if (static_cast<uint64_t>(Info.st_size) > Most)
      return Error{Path, fmt::format("a file of {} bytes, expected at most {}",
                                     Info.st_size, Most)};
  } else {
    Most = std::min(Most, StreamLimit);
  }
  std::vector<std::byte> Bytes;
  if (SaysSize)
    Bytes.reserve(static_cast<std::size_t>(Info.st_size));
  std::vector<std::byte> Chunk(std::size_t{1} << 16);
  for (;;) {
    const auto Got = readSome(File.number(), Chunk.data(), Chunk.size());
    if (!Got)
      return cannot(Path, "read", errno);
    if (*Got == 0)
      return Bytes;
    if (Bytes.size() + *Got > Most)
      return Error{Path, fmt::format("more than {0} bytes without an end, "
                                     "expected at most {0}",
                                     Most)};
    Bytes.insert(Bytes.end(), Chunk.begin(),
                 Chunk.begin() + static_cast<std::ptrdiff_t>(*Got));
  }
}

} // namespace vorion
