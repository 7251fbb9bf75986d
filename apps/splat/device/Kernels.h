/// The kernel sources of this program, put into it at build time.
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

/// The text of the program \p File of kernels/, or of \p Folder if that is not
/// empty, with the text of what it includes in place of each #include, so that
/// the compiler needs no files. Its messages name the files and their lines. An
/// Error if a file is missing.
Expected<std::string> programText(const std::string &File,
                                  const std::string &Folder = "");

} // namespace vorion::splat
