//===- BuildLog.h - messages in the words of the program ------------------===//

#ifndef VORION_POCL_BUILD_LOG_H
#define VORION_POCL_BUILD_LOG_H

#include <string>
#include <string_view>

namespace pocl {

/// What clang printed, as the program's author sees it: without the macros of
/// _builtin_renames.h, which give the built-in functions the names that they
/// have in the library (sin is _cl_sin there).
std::string asTheAuthorSees(std::string_view Text);

} // namespace pocl

#endif
