/// A record of the programs that this computer has compiled.
#pragma once

#include <string>

namespace vorion::splat {

/// The folder of PoCL's kernel cache (its documentation, "POCL_CACHE_DIR");
/// empty if there is none.
std::string kernelCacheFolder();

/// One marker file per program in PoCL's kernel cache, so that clearing the
/// cache clears the record. A wrong marker costs time and changes no result.
class BuildRecord {
public:
  /// Uses the folder of the kernel cache from PoCL's environment; without a
  /// cache the record is always empty.
  BuildRecord();
  explicit BuildRecord(std::string Folder);

  /// \p Key: the provenance of a program, which is hashed to a file name.
  bool has(const std::string &Key) const;
  void add(const std::string &Key) const;

private:
  std::string Folder; ///< empty: none
};

} // namespace vorion::splat
