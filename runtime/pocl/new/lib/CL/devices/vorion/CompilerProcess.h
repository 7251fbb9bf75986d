/// The compiler, vorion-compiler, as processes that are kept for further
/// kernels: their start is most of the compile time of a small kernel
/// (docs/adr/0010-one-compiler-process.md). A crash of the compiler does not
/// end this process.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace vorion {

/// Why the compiler gave no response.
struct CompilerFailure {
  /// What happened, in one line, such as "the compiler crashed (signal 11)".
  std::string Text;
  /// What it printed before, such as a fatal error of LLVM.
  std::string Printed;
  /// Whether it ran out of memory or time, or could not be started: the program
  /// may be good.
  bool LackedResources = false;

  /// Text and what was printed, or the beginning of it.
  std::string message() const {
    constexpr size_t MaxPrinted = 65536;
    return Printed.empty() ? Text : Text + "\n" + Printed.substr(0, MaxPrinted);
  }
};

/// A program that is started as the compiler.
struct CompilerProgram {
  std::string File;
  std::vector<std::string> Environment; ///< NAME=VALUE
  /// Whether it may serve another request.
  bool Stays = true;
  /// How long it may give no answer before it is ended; 0 is for ever.
  unsigned Seconds = 0;
};

/// The response of \p Compiler to \p Request: of a process that is idle, or of
/// a new one. A new one gets the request once more if the first ends without a
/// response by itself.
std::variant<std::string, CompilerFailure>
askCompiler(const CompilerProgram &Compiler, const std::string &Request);

} // namespace vorion
