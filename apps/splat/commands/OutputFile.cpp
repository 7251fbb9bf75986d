#include "OutputFile.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <unistd.h>

namespace vorion::splat {

Expected<Success> checkWritable(const std::string &File) {
  if (File.empty())
    return Success{};
  const std::filesystem::path Path(File);
  std::error_code Ignored;
  if (std::filesystem::is_directory(Path, Ignored))
    return Error{File, "cannot write: is a folder, expected a file"};
  const std::string Folder =
      Path.has_parent_path() ? Path.parent_path().string() : ".";
  if (access(Folder.c_str(), W_OK | X_OK) != 0)
    return Error{File, std::string("cannot write: ") + std::strerror(errno) +
                           ", expected a folder that can be written"};
  return Success{};
}

} // namespace vorion::splat
