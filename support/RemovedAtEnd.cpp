#include "vorion/support/RemovedAtEnd.h"

#include <array>
#include <atomic>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <string_view>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace vorion {
namespace {

// The handler of a signal may take no memory and no lock. So what it needs lies
// in places that never move.
enum class State : int { Free, Taken, Filled };
static_assert(std::atomic<State>::is_always_lock_free);
struct Place {
  std::atomic<State> Is = State::Free;
  pid_t Owner = 0; ///< a copy of the process has these places, too
  std::array<char, PATH_MAX> Path{};
};
std::array<Place, 64> Places;

/// Removes \p Name, which \p Folder holds, and what is in it.
void removeAll(int Folder, const char *Name);

void removeContents(int Folder) {
  // opendir() takes memory; this is what it calls.
  alignas(dirent64) std::array<char, 2048> Entries;
  long Size = 0;
  while ((Size = ::syscall(SYS_getdents64, Folder, Entries.data(),
                           Entries.size())) > 0)
    for (long At = 0; At < Size;) {
      const auto *Entry = reinterpret_cast<const dirent64 *>(&Entries[At]);
      At += Entry->d_reclen;
      const std::string_view Name(Entry->d_name);
      if (Name != "." && Name != "..")
        removeAll(Folder, Entry->d_name);
    }
}

void removeAll(int Folder, const char *Name) {
  if (::unlinkat(Folder, Name, 0) == 0)
    return;
  const int Inner =
      ::openat(Folder, Name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (Inner < 0)
    return;
  removeContents(Inner);
  ::close(Inner);
  ::unlinkat(Folder, Name, AT_REMOVEDIR);
}

} // namespace

RemovedAtEnd::RemovedAtEnd(const std::string &Path) : Slot(-1) {
  if (Path.size() >= PATH_MAX)
    return;
  for (std::size_t I = 0; I != Places.size(); ++I) {
    State Expected = State::Free;
    if (!Places[I].Is.compare_exchange_strong(Expected, State::Taken))
      continue;
    Slot = static_cast<int>(I);
    Places[I].Owner = ::getpid();
    std::memcpy(Places[I].Path.data(), Path.c_str(), Path.size() + 1);
    Places[I].Is = State::Filled;
    return;
  }
}

RemovedAtEnd::~RemovedAtEnd() {
  if (Slot >= 0)
    Places[static_cast<std::size_t>(Slot)].Is = State::Free;
}

void removeAtEnd() {
  for (const Place &P : Places)
    if (P.Is == State::Filled && P.Owner == ::getpid())
      removeAll(AT_FDCWD, P.Path.data());
}

} // namespace vorion
