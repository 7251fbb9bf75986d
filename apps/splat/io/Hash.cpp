#include "io/Hash.h"

#include "vorion/support/File.h"

#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <system_error>

namespace vorion::splat {

Expected<std::string> hashScene(const std::string &Path) {
  namespace fs = std::filesystem;
  fs::path Folder(Path);
  if (Folder.extension() == ".json")
    Folder = Folder.has_parent_path() ? Folder.parent_path() : fs::path(".");
  std::error_code Failed;
  if (!fs::is_directory(Folder, Failed))
    return fnv1a64OfFile(Path);
  std::set<std::string> Names;
  for (fs::recursive_directory_iterator It(Folder, Failed), End;
       !Failed && It != End; It.increment(Failed))
    if (It->is_regular_file(Failed))
      Names.insert(It->path().lexically_relative(Folder).string());
  if (Failed)
    return Error{Folder.string(),
                 fmt::format("cannot list: {}, expected a readable folder",
                             Failed.message())};
  std::string Hashes;
  for (const std::string &Name : Names) {
    const auto Hash = fnv1a64OfFile((Folder / Name).string());
    if (!Hash)
      return Hash.error();
    Hashes += fmt::format("{} {}\n", *Hash, Name);
  }
  return fnv1a64(Hashes);
}

} // namespace vorion::splat
