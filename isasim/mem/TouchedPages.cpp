#include "mem/TouchedPages.h"

#include <algorithm>
#include <cstdint>
#include <fcntl.h>
#include <unistd.h>

namespace vorion::isasim {

namespace {

/// In memory, or swapped out: bits 63 and 62 of a page's entry.
constexpr uint64_t HasMemory = uint64_t{3} << 62;

/// The host's entries of \p Pages pages from page \p First on; fewer where it
/// does not tell.
std::vector<uint64_t> entriesOf(uint64_t First, size_t Pages) {
  std::vector<uint64_t> Entries(Pages);
  const int File = ::open("/proc/self/pagemap", O_RDONLY | O_CLOEXEC);
  if (File < 0)
    return {};
  size_t Bytes = 0;
  const size_t All = Pages * sizeof(uint64_t);
  while (Bytes != All) {
    const ssize_t Got = ::pread(
        File, reinterpret_cast<std::byte *>(Entries.data()) + Bytes,
        All - Bytes, static_cast<off_t>(First * sizeof(uint64_t) + Bytes));
    if (Got <= 0)
      break;
    Bytes += static_cast<size_t>(Got);
  }
  ::close(File);
  Entries.resize(Bytes / sizeof(uint64_t));
  return Entries;
}

} // namespace

std::vector<bool> touchedPages(std::span<const std::byte> Memory,
                               size_t PageBytes) {
  const auto HostPage = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  const size_t Size = Memory.size();
  const size_t HostPages = (Size + HostPage - 1) / HostPage;
  const std::vector<uint64_t> Entries = entriesOf(
      reinterpret_cast<uintptr_t>(Memory.data()) / HostPage, HostPages);
  const bool IsTold = Entries.size() == HostPages;
  std::vector<bool> Touched((Size + PageBytes - 1) / PageBytes, !IsTold);
  // Pages of the two kinds may be of either size: each marks what it lies on.
  for (size_t H = 0; IsTold && H != HostPages; ++H)
    if (Entries[H] & HasMemory) {
      const size_t End = std::min(Size, (H + 1) * HostPage);
      for (size_t P = H * HostPage / PageBytes; P * PageBytes < End; ++P)
        Touched[P] = true;
    }
  return Touched;
}

} // namespace vorion::isasim
