#include "vorion/support/File.h"

#include "Descriptor.h"
#include "vorion/support/Hash.h"
#include "vorion/support/HostMemory.h"

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

/// What is no regular file.
const char *kindOf(mode_t Mode) {
  return S_ISDIR(Mode)    ? "a folder"
         : S_ISFIFO(Mode) ? "a pipe"
         : S_ISSOCK(Mode) ? "a socket"
                          : "a device";
}

/// A file that is open to be read, and what fstat() says of it.
struct OpenFile {
  Descriptor File;
  struct stat Info;
};

Error notRegular(const std::string &Path, mode_t Mode) {
  return {Path, fmt::format("{}, expected a regular file", kindOf(Mode))};
}

Expected<OpenFile> openFile(const std::string &Path, bool OnlyRegular) {
  if (auto Checked = checkName(Path); !Checked)
    return Checked.error();
  // A pipe that is only looked at must not be opened: its writer would go on,
  // and lose what it writes.
  struct stat Named{};
  if (OnlyRegular && ::stat(Path.c_str(), &Named) == 0 &&
      !S_ISREG(Named.st_mode))
    return notRegular(Path, Named.st_mode);
  // One that has taken the name since then would wait for its writer.
  const int Wait = OnlyRegular ? O_NONBLOCK : 0;
  OpenFile O{
      Descriptor(::open(Path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | Wait)),
      {}};
  if (O.File.number() < 0 || ::fstat(O.File.number(), &O.Info) != 0)
    return cannot(Path, "open", errno);
  if (OnlyRegular && !S_ISREG(O.Info.st_mode))
    return notRegular(Path, O.Info.st_mode);
  return O;
}

/// Gives the bytes of \p Opened to \p Take, a chunk at a time. Before, \p Begin
/// gets their number if the file says it, else 0.
template <typename Beginning, typename Taking>
Expected<Success> readChunks(const std::string &Path,
                             const Expected<OpenFile> &Opened, uint64_t Most,
                             Beginning Begin, Taking Take) {
  if (!Opened)
    return Opened.error();
  const auto &[File, Info] = *Opened;
  // Files of /proc call themselves regular and empty.
  const bool SaysSize = S_ISREG(Info.st_mode) && Info.st_size > 0;
  if (SaysSize) {
    Most = std::min(Most, hostMemory());
    if (static_cast<uint64_t>(Info.st_size) > Most)
      return Error{Path, fmt::format("a file of {} bytes, expected at most {}",
                                     Info.st_size, Most)};
  } else {
    Most = std::min(Most, StreamLimit);
  }
  Begin(SaysSize ? static_cast<std::size_t>(Info.st_size) : 0);
  std::vector<std::byte> Chunk(std::size_t{1} << 16);
  uint64_t Read = 0;
  for (;;) {
    const auto Got = readSome(File.number(), Chunk.data(), Chunk.size());
    if (!Got)
      return cannot(Path, "read", errno);
    if (*Got == 0)
      return Success{};
    Read += *Got;
    if (Read > Most)
      return Error{
          Path, fmt::format("more than {0} bytes, expected at most {0}", Most)};
    Take(std::span<const std::byte>(Chunk.data(), *Got));
  }
}

Expected<std::vector<std::byte>> readAll(const std::string &Path,
                                         const Expected<OpenFile> &Opened,
                                         uint64_t Most) {
  std::vector<std::byte> Bytes;
  const auto All = readChunks(
      Path, Opened, Most, [&](std::size_t Size) { Bytes.reserve(Size); },
      [&](std::span<const std::byte> Chunk) {
        Bytes.insert(Bytes.end(), Chunk.begin(), Chunk.end());
      });
  if (!All)
    return All.error();
  return Bytes;
}

} // namespace

Expected<Success> checkName(const std::string &Path) {
  if (Path.find('\0') == std::string::npos)
    return Success{};
  return Error{Path, "a NUL in the name, expected a name without one"};
}

Expected<std::vector<std::byte>> readFile(const std::string &Path,
                                          uint64_t Most) {
  return readAll(Path, openFile(Path, /*OnlyRegular=*/false), Most);
}

Expected<std::vector<std::byte>> readRegularFile(const std::string &Path,
                                                 uint64_t Most) {
  return readAll(Path, openFile(Path, /*OnlyRegular=*/true), Most);
}

Expected<uint64_t> xxh3OfFile(const std::string &Path) {
  Xxh3 Hash;
  const auto All = readChunks(
      Path, openFile(Path, /*OnlyRegular=*/true), UINT64_MAX,
      [](std::size_t) {},
      [&](std::span<const std::byte> Chunk) { Hash.add(Chunk); });
  if (!All)
    return All.error();
  return Hash.value();
}

Expected<std::string> fnv1a64OfFile(const std::string &Path) {
  uint64_t Hash = fnv1a({});
  const auto All = readChunks(
      Path, openFile(Path, /*OnlyRegular=*/true), UINT64_MAX,
      [](std::size_t) {},
      [&](std::span<const std::byte> Chunk) {
        Hash = fnv1a(
            {reinterpret_cast<const char *>(Chunk.data()), Chunk.size()}, Hash);
      });
  if (!All)
    return All.error();
  return hexOf(Hash);
}

Expected<std::vector<std::byte>> readStart(const std::string &Path,
                                           std::size_t Size) {
  const auto Opened = openFile(Path, /*OnlyRegular=*/true);
  if (!Opened)
    return Opened.error();
  std::vector<std::byte> Start(Size);
  std::size_t Have = 0;
  while (Have < Size) {
    const auto Got =
        readSome(Opened->File.number(), Start.data() + Have, Size - Have);
    if (!Got)
      return cannot(Path, "read", errno);
    if (*Got == 0)
      break;
    Have += *Got;
  }
  Start.resize(Have);
  return Start;
}

} // namespace vorion
