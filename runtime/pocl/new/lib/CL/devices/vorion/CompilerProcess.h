/// The compiler, vorion-compiler, as processes that stay: of the time for a
/// small kernel most is their start (docs/backend.md, "Cost"). What happens to
/// one of them does not happen to this process.
#pragma once

#include <string>
#include <variant>

namespace vorion {

/// Why the compiler gave no response.
struct CompilerFailure {
  /// What happened, in one line, such as "the compiler crashed (signal 11)".
  std::string Text;
  /// What it printed before, such as a fatal error of LLVM.
  std::string Printed;
  /// Whether it ran out of memory, or could not be started: the kernel may be
  /// good.
  bool LackedResources = false;
};

/// The response of \p Compiler, a file, to \p Request: of a process that is
/// idle, or of a new one. A new one gets the request once more if the first
/// ends without a response. With \p Stays false, the process serves this
/// request only.
std::variant<std::string, CompilerFailure>
askCompiler(const std::string &Compiler, const std::string &Request,
            bool Stays);

} // namespace vorion
