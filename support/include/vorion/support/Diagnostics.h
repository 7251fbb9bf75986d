/// The one form of message: `tool: error: file:line: what is wrong, what was
/// expected`. Only a tool's main function prints and exits.
#pragma once

#include "vorion/support/Expected.h"

#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace vorion {

/// Writes a message to stderr; \p Severity is "error", "warning" or "note".
/// Colour only on a terminal. \p What may have several lines, as a report of a
/// trap has. What a terminal would obey is escaped, since names of files and in
/// files may hold anything.
void printDiagnostic(std::string_view Tool, std::string_view Severity,
                     std::string_view Where, std::string_view What);

/// Prints \p E as an error of \p Tool on one line, and gives the exit code for
/// `main`.
int reportError(std::string_view Tool, const Error &E);

/// For a command line that the parser refuses with \p What, which seldom names
/// what it would have taken.
int reportUsageError(std::string_view Tool, std::string_view What);

/// Writes \p Text to stdout, escaped as messages are but for its own lines.
/// What stdout does not take is seen at the end (Tool.h).
void printText(std::string_view Text);

/// From now on what is printed goes to stderr: stdout gets a file (Outputs.h).
void printToStandardError();

/// printText(), formatted.
template <typename... Values>
void printOut(fmt::format_string<Values...> Format, Values &&...Of) {
  printText(fmt::format(Format, std::forward<Values>(Of)...));
}

/// Writes \p Text to stderr as printText() does: what is no message.
void printNote(std::string_view Text);

/// The last lines of every tool's `--help`.
inline constexpr std::string_view ExitCodeHelp =
    "exit codes: 0 ok, 1 guest failed, 2 usage, 3 input or output file, "
    "4 trap, 5 limit reached, 70 internal";

} // namespace vorion
