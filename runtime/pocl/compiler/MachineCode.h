/// From a kernel's bitcode to its image.
#pragma once

#include "CompilerMessages.h"

namespace vorion {

/// Compiles and links as `vorion-clang` does, of which \p Bin is the folder.
/// What is printed on the way goes to standard error, not into the answer. A
/// fatal error of LLVM or lld ends the process.
ImageAnswer makeImage(const ImageRequest &Request, const std::string &Bin);

} // namespace vorion
