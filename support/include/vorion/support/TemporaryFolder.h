/// A folder for as long as somebody needs it.
#pragma once

#include "vorion/support/Expected.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace vorion {

/// Below TMPDIR; it goes with all that is in it when this does.
class TemporaryFolder {
public:
  /// Its name begins with \p Prefix.
  static Expected<TemporaryFolder> make(std::string_view Prefix) {
    std::error_code Failed;
    std::string Path = (std::filesystem::temp_directory_path(Failed) /
                        (std::string(Prefix) + "-XXXXXX"))
                           .string();
    if (Failed || !mkdtemp(Path.data()))
      return Error{"", "cannot make a temporary folder: " +
                           (Failed ? Failed.message()
                                   : std::string(std::strerror(errno))) +
                           ", expected TMPDIR to allow one"};
    return TemporaryFolder(std::move(Path));
  }
  TemporaryFolder(TemporaryFolder &&From) noexcept
      : Path(std::exchange(From.Path, {})) {}
  TemporaryFolder &operator=(TemporaryFolder &&) = delete;
  ~TemporaryFolder() {
    std::error_code Ignored;
    if (!Path.empty())
      std::filesystem::remove_all(Path, Ignored);
  }

  const std::string &path() const { return Path; }

private:
  explicit TemporaryFolder(std::string PathIn) : Path(std::move(PathIn)) {}
  std::string Path;
};

} // namespace vorion
