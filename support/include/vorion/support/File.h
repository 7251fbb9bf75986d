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

/// What is read at most of a device or a pipe, which does not say its size.
inline constexpr std::uint64_t StreamLimit = std::uint64_t{1} << 30;

/// Reads all of \p Path, of \p Most bytes at most. A regular file says how many
/// it has, and one that the machine's memory cannot hold is an error before
/// memory is taken. Of devices and pipes, StreamLimit bytes are read at most.
/// Directories and unreadable files are errors.
Expected<std::vector<std::byte>> readFile(const std::string &Path,
                                          std::uint64_t Most = UINT64_MAX);

/// Writes \p Size bytes beside \p Path and renames the result to it, so that
/// an interrupted run leaves either the old file or the new one.
Expected<Success> writeFileAtomically(const std::string &Path, const void *Data,
                                      std::size_t Size);
Expected<Success> writeFileAtomically(const std::string &Path,
                                      std::string_view Text);

} // namespace vorion
