/// Whole files in, and files that appear under their name complete or not at
/// all.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vorion {

/// That \p Path has no NUL, behind which the system would not look: it would
/// take the name for that of another file.
Expected<Success> checkName(const std::string &Path);

/// What is read at most of a device or a pipe, which does not say its size.
inline constexpr uint64_t StreamLimit = uint64_t{1} << 30;

/// Reads all of \p Path, of \p Most bytes at most. A regular file says how many
/// it has, and one that the machine's memory cannot hold is an error before
/// memory is taken. Of devices and pipes, StreamLimit bytes are read at most.
/// Directories and unreadable files are errors.
Expected<std::vector<std::byte>> readFile(const std::string &Path,
                                          uint64_t Most = UINT64_MAX);

/// The same of a file that a folder or another file names, which must be a
/// regular one: nobody means a device there, and a pipe may never get a writer.
/// Whatever takes the name's place meanwhile, this waits for nothing.
Expected<std::vector<std::byte>> readRegularFile(const std::string &Path,
                                                 uint64_t Most = UINT64_MAX);

/// The first \p Size bytes of a regular file, or all if it is shorter.
Expected<std::vector<std::byte>> readStart(const std::string &Path,
                                           std::size_t Size);

/// The path that means standard output to whatever writes a file.
inline constexpr std::string_view StandardOutput = "-";

/// Writes \p Size bytes to \p Path. A regular file is written aside,
/// synchronized with its disk and renamed, so that an interrupted run leaves
/// either the old file or the new one; it keeps the permissions of the one that
/// it replaces and, as far as we may, its owner. Of a symbolic link the target
/// is replaced. Devices, pipes and standard output, whose name is
/// StandardOutput, are written through.
Expected<Success> writeFileAtomically(const std::string &Path, const void *Data,
                                      std::size_t Size);
Expected<Success> writeFileAtomically(const std::string &Path,
                                      std::string_view Text);

/// A file and what it shall hold.
struct FileContent {
  std::string Path;
  std::string_view Content;
};

/// Writes several files that are one thing, of which the last is the index that
/// names the others. All are written aside before any is renamed, so that what
/// was there stays whole if one cannot be written. The index that was there
/// goes before the first is renamed: an interrupt among the renames leaves no
/// index, and never one of other files.
Expected<Success> writeFilesTogether(const std::vector<FileContent> &Files);

/// Whether writeFileAtomically() could write \p Path, asked before the work
/// whose result it gets. Makes a file in its folder for a moment.
Expected<Success> checkWritable(const std::string &Path);

/// The file that \p Path names through symbolic links; the last of them may
/// name one that is not there yet.
std::string targetOf(const std::string &Path);

} // namespace vorion
