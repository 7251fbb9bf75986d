/// Names of other files, as files have them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace vorion::splat {

/// Whether \p Name, which a file of a folder gives, can only name what lies in
/// that folder (links in it apart, which are its owner's). One with a `..` is
/// refused even where it would come back: behind a link it need not.
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

/// \p Name, in which there may be folders, as the name of one file.
inline std::string asFileName(std::string Name) {
  std::ranges::replace(Name, '/', '_');
  return Name;
}

} // namespace vorion::splat
