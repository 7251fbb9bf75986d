/// A temporary folder.
#pragma once

#include "vorion/support/Environment.h"
#include "vorion/support/Expected.h"
#include "vorion/support/RemovedAtEnd.h"
#include "vorion/support/Trust.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace vorion {

/// In TMPDIR, protected from replacement by other users. Removed with its
/// contents by the destructor, or when a signal terminates the tool
/// (RemovedAtEnd.h).
class TemporaryFolder {
public:
  /// Its name begins with \p Prefix.
  static Expected<TemporaryFolder> make(std::string_view Prefix) {
    const char *Place = environmentVariable("TMPDIR");
    std::string Path = (std::filesystem::path(Place ? Place : "/tmp") /
                        (std::string(Prefix) + "-XXXXXX"))
                           .string();
    if (!mkdtemp(Path.data()))
      return cannotMake(std::strerror(errno));
    TemporaryFolder Made(std::move(Path));
    if (const std::string Why = whyUntrusted(Made.Path, ::geteuid());
        !Why.empty())
      return cannotMake(Why);
    return Made;
  }
  TemporaryFolder(TemporaryFolder &&From) noexcept
      : Path(std::exchange(From.Path, {})), Maker(From.Maker),
        AtEnd(std::move(From.AtEnd)) {}
  TemporaryFolder &operator=(TemporaryFolder &&) = delete;
  ~TemporaryFolder() {
    std::error_code Ignored;
    // A forked process does not remove it.
    if (!Path.empty() && Maker == ::getpid())
      std::filesystem::remove_all(Path, Ignored);
  }

  const std::string &path() const { return Path; }

private:
  static Error cannotMake(const std::string &Why) {
    return {"", "cannot create a temporary folder: " + Why +
                    ", expected TMPDIR to name a writable folder"};
  }
  explicit TemporaryFolder(std::string PathIn)
      : Path(std::move(PathIn)), AtEnd(Path) {}
  std::string Path;
  pid_t Maker = ::getpid();
  RemovedAtEnd AtEnd;
};

} // namespace vorion
