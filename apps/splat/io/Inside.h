/// File names in other files.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace vorion::splat {

/// Whether \p Name, found in a file of a folder, refers to a file inside that
/// folder (apart from symbolic links, which are trusted). A name with `..` is
/// rejected even if it leads back, because after a link it may not.
inline bool staysInside(const std::string &Name) {
  const std::filesystem::path Path(Name);
  if (Name.empty() || Name.find('\0') != std::string::npos ||
      Path.is_absolute())
    return false;
  for (const std::filesystem::path &Part : Path)
    if (Part == "..")
      return false;
  return true;
}

/// \p Name, which may have folders, converted to a plain file name.
inline std::string asFileName(std::string Name) {
  std::ranges::replace(Name, '/', '_');
  return Name;
}

} // namespace vorion::splat
