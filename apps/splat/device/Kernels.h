/// The kernel sources, embedded at build time.
#pragma once

#include "vorion/support/Expected.h"

#include <span>
#include <string>
#include <string_view>

namespace vorion::splat {

/// The names of the files in kernels/.
std::span<const std::string_view> kernelFiles();

/// The text of kernels/\p File; empty if there is no such file.
std::string_view kernelSource(std::string_view File);

/// The source of the program \p File in kernels/, or in \p Folder if that is
/// not empty, with all #include directives expanded, so that the compiler needs
/// no files. Line directives preserve file names and lines in messages. An
/// Error if a file is missing.
Expected<std::string> programText(const std::string &File,
                                  const std::string &Folder = "");

} // namespace vorion::splat
