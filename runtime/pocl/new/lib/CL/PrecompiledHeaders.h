//===- PrecompiledHeaders.h - OpenCL's declarations, parsed once ----------===//
//
// To parse the headers that declare OpenCL's built-in functions takes 0.1 s,
// some ten times what a small kernel takes itself. clang can keep what it knows
// after them (a precompiled header) and read of it only what a program uses.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_POCL_PRECOMPILED_HEADERS_H
#define VORION_POCL_PRECOMPILED_HEADERS_H

#include <clang/Frontend/CompilerInstance.h>

#include <memory>
#include <string>
#include <vector>

namespace pocl {

/// Bytes, or none.
struct HeadersState {
  std::shared_ptr<const char> Bytes;
  size_t Size = 0;
};

/// What clang knows after a row of headers. It is kept in memory for the
/// programs of this process, and in the kernel cache for others.
class PrecompiledHeaders {
public:
  /// \param Program     how a program is compiled, without these headers
  /// \param Headers     absolute paths, in their order
  /// \param UserOptions of clBuildProgram. A macro that only they define is the
  ///                    program's: the headers do not see it, so that programs
  ///                    with different macros share what is kept.
  PrecompiledHeaders(const clang::CompilerInvocation &Program,
                     std::vector<std::string> Headers,
                     llvm::StringRef UserOptions);

  /// Names the headers' contents and the options that they were parsed with.
  const std::string &key() const { return Key; }

  /// Lets a program begin with the headers: with what is kept of them or, where
  /// they could not be parsed, with their text, whose errors are the program's.
  /// To be called before the first action, and to outlive the last.
  void addTo(clang::CompilerInstance &Instance) const;

private:
  std::vector<std::string> Headers;
  std::string Key;
  HeadersState State; ///< none if they cannot be parsed
};

} // namespace pocl

#endif
