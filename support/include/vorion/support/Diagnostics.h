/// The one form of message: `tool: error: file:line: what is wrong, what was
/// expected`. Only a tool's main function prints and exits.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdio>
#include <fmt/format.h>
#include <string_view>
#include <unistd.h>

namespace vorion {

/// Writes one line to stderr; \p Severity is "error", "warning" or "note".
/// Colour only on a terminal.
inline void printDiagnostic(std::string_view Tool, std::string_view Severity,
                            std::string_view Where, std::string_view What) {
  const bool Colour = isatty(STDERR_FILENO) != 0;
  const char *On = !Colour                 ? ""
                   : Severity == "error"   ? "\033[1;31m"
                   : Severity == "warning" ? "\033[1;35m"
                                           : "\033[1;36m";
  fmt::print(stderr, "{}: {}{}:{} {}{}{}\n", Tool, On, Severity,
             Colour ? "\033[0m" : "", Where, Where.empty() ? "" : ": ", What);
}

/// Prints \p E as an error of \p Tool and gives the exit code for `main`.
inline int reportError(std::string_view Tool, const Error &E) {
  printDiagnostic(Tool, "error", E.Where, E.What);
  return static_cast<int>(E.Code);
}

/// For a command line that the parser refuses with \p What, which seldom names
/// what it would have taken.
inline int reportUsageError(std::string_view Tool, std::string_view What) {
  return reportError(Tool, {"", fmt::format("{}, expected: see --help", What),
                            ExitCode::Usage});
}

/// The last lines of every tool's `--help`.
inline constexpr std::string_view ExitCodeHelp =
    "exit codes: 0 ok, 1 guest failed, 2 usage, 3 input or output file, "
    "4 trap, 5 limit reached, 70 internal";

} // namespace vorion
