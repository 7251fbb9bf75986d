// The pictures of a capture, found by the names in its files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vorion::splat {

/// Pictures by names, and what was done to find them.
struct MatchedPictures {
  /// One for each name: the file, or the path at which it is missing.
  std::vector<std::filesystem::path> Files;
  /// Lines for users about names that are not those of their files.
  std::vector<std::string> Notes;
  /// Number of files that exist.
  std::size_t Found = 0;
};

/// The pictures \p Names in \p Folder. A name may lack its extension. If there
/// is no such file, the name is compared with those of the other pictures in
/// \p Folder and below it: with slashes for backslashes; then without regard to
/// case, and to the number and encoding of blanks; then without the extension.
/// If no name at all was found so, folders are ignored, too. A file must be the
/// only one of its name at the first rule that finds one, and is used once.
MatchedPictures matchPictures(const std::filesystem::path &Folder,
                              const std::vector<std::string> &Names);

} // namespace vorion::splat
