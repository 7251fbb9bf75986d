/// Reading of complete files, and atomic writing.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vorion {

/// Checks that \p Path has no NUL, after which the system would ignore the rest
/// of the name.
Expected<Success> checkName(const std::string &Path);

/// Maximum number of bytes that are read from a device or a pipe, whose size is
/// unknown.
inline constexpr uint64_t StreamLimit = uint64_t{1} << 30;

/// Reads the file \p Path of at most \p Most bytes. A regular file that is
/// larger than the host's memory is an error before memory is allocated. At
/// most StreamLimit bytes of devices and pipes are read. Directories and
/// unreadable files are errors.
Expected<std::vector<std::byte>> readFile(const std::string &Path,
                                          uint64_t Most = UINT64_MAX);

/// The same for a file to which a folder or another file refers, which must be
/// a regular file, because a pipe may never get a writer. Never blocks, even if
/// the file is replaced concurrently.
Expected<std::vector<std::byte>> readRegularFile(const std::string &Path,
                                                 uint64_t Most = UINT64_MAX);

/// XXH3, 64 bits, of a regular file, of which a part is in memory at a time.
Expected<uint64_t> xxh3OfFile(const std::string &Path);

/// The same with fnv1a64().
Expected<std::string> fnv1a64OfFile(const std::string &Path);

/// The first \p Size bytes of a regular file, or all if it is shorter.
Expected<std::vector<std::byte>> readStart(const std::string &Path,
                                           std::size_t Size);

/// The file name that denotes standard output.
inline constexpr std::string_view StandardOutput = "-";

/// Writes \p Size bytes to \p Path atomically: to a temporary file that is
/// synchronized and renamed, so that an interrupted run leaves either the old
/// file or the new one. The file keeps the permissions of the replaced one and,
/// if permitted, its owner. The target of a symbolic link is replaced. Devices,
/// pipes and standard output (StandardOutput) are written directly.
Expected<Success> writeFileAtomically(const std::string &Path, const void *Data,
                                      std::size_t Size);
Expected<Success> writeFileAtomically(const std::string &Path,
                                      std::string_view Text);

/// A file and its new contents.
struct FileContent {
  std::string Path;
  std::string_view Content;
};

/// Writes a group of files, of which the last is the index that refers to the
/// others. All are written to temporary files before any is renamed, so that
/// existing files are preserved if a write fails. The old index is removed
/// before the first rename: an interrupt between renames leaves no index, and
/// never an inconsistent one.
Expected<Success> writeFilesTogether(const std::vector<FileContent> &Files);

/// Checks before a long computation that writeFileAtomically() can write \p
/// Path. Creates a temporary file in its folder.
Expected<Success> checkWritable(const std::string &Path);

/// The target of \p Path through symbolic links, which need not exist.
std::string targetOf(const std::string &Path);

} // namespace vorion
