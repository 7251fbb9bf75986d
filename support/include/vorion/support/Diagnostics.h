/// The format of all messages: `tool: error: file:line: what is wrong, what was
/// expected`. Only a tool's main function prints and exits.
#pragma once

#include "vorion/support/Expected.h"

#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace vorion {

/// Writes a message to stderr; \p Severity is "error", "warning" or "note".
/// Colour only on a terminal. \p What may have several lines, for example a
/// trap report. Control characters are escaped, because the names of files and
/// in files are untrusted.
void printDiagnostic(std::string_view Tool, std::string_view Severity,
                     std::string_view Where, std::string_view What);

/// Prints \p E as an error of \p Tool on one line, and returns the exit code
/// for `main`.
int reportError(std::string_view Tool, const Error &E);

/// Error for a command line that the parser rejects with \p What, which usually
/// does not name the expected value.
int reportUsageError(std::string_view Tool, std::string_view What);

/// Writes \p Text to stdout, escaped like messages except for line ends. Write
/// errors of stdout are reported at exit (Tool.h).
void printText(std::string_view Text);

/// Redirects printed text to stderr, because stdout receives a file
/// (Outputs.h).
void printToStandardError();

/// printText(), formatted.
template <typename... Values>
void printOut(fmt::format_string<Values...> Format, Values &&...Of) {
  printText(fmt::format(Format, std::forward<Values>(Of)...));
}

/// Writes \p Text to stderr like printText(), without the format of a message.
void printNote(std::string_view Text);

/// The last lines of every tool's `--help`.
inline constexpr std::string_view ExitCodeHelp =
    "exit codes: 0 ok, 1 guest failed, 2 usage, 3 input or output file, "
    "4 trap, 5 limit reached, 70 internal";

} // namespace vorion
