/// Which programs this computer has compiled before.
#pragma once

#include <string>

namespace vorion::splat {

/// Where PoCL keeps compiled kernels (its documentation, "POCL_CACHE_DIR");
/// empty if it keeps none.
std::string kernelCacheFolder();

/// A mark a program beside PoCL's cached kernels, so that what clears the cache
/// clears the record. A mark that is wrong costs time and changes no result.
class BuildRecord {
public:
  /// In the folder of the kernel cache, as PoCL's environment names it; without
  /// a cache nothing is ever known or kept.
  BuildRecord();
  explicit BuildRecord(std::string Folder);

  /// \p Key: what made a program, hashed to a file's name.
  bool has(const std::string &Key) const;
  void add(const std::string &Key) const;

private:
  std::string Folder; ///< empty: none
};

} // namespace vorion::splat
