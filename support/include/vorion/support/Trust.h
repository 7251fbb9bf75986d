/// Whether other users of this host could have written what a path names.
#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>

namespace vorion {

/// Why someone else than root and \p Owner can make, change or replace what
/// \p Path names: "PATH belongs to user 1000". Empty if nobody can. Links are
/// followed. \p Path must belong to \p Owner, and each folder on the way to it
/// to \p Owner or root. Nobody else may write them; in a folder on the way with
/// the sticky bit, such as /tmp, everybody may make files.
std::string whyUntrusted(const std::filesystem::path &Path, uid_t Owner);

/// Makes the folder \p Path, and those on the way to it, for this user alone,
/// unless it is there. Why it is of no use: it cannot be made or written, or is
/// not trusted; empty if it is good. Makes nothing below what is not trusted.
std::string makeOwnFolder(const std::filesystem::path &Path);

} // namespace vorion
