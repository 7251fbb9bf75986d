#include "vorion/support/Diagnostics.h"

#include "vorion/support/Printable.h"
#include "vorion/support/StatusLine.h"
#include "vorion/support/Terminal.h"

#include <cstdio>
#include <string>

namespace vorion {
namespace {

/// Of the process, as its standard output is.
bool IsOutputTaken = false;

/// Never throws for what \p To does not take: there is nobody left to tell.
void write(std::FILE *To, const std::string &Text) {
  clearStatus();
  static_cast<void>(std::fwrite(Text.data(), 1, Text.size(), To));
}

} // namespace

void printDiagnostic(std::string_view Tool, std::string_view Severity,
                     std::string_view Where, std::string_view What) {
  const bool Colour = canColour();
  const char *On = !Colour                 ? ""
                   : Severity == "error"   ? "\033[1;31m"
                   : Severity == "warning" ? "\033[1;35m"
                                           : "\033[1;36m";
  write(stderr, fmt::format("{}: {}{}:{} {}{}{}\n", Tool, On, Severity,
                            Colour ? "\033[0m" : "", escaped(Where),
                            Where.empty() ? "" : ": ", escapedLines(What)));
}

int reportError(std::string_view Tool, const Error &E) {
  printDiagnostic(Tool, "error", E.Where, escaped(E.What));
  return static_cast<int>(E.Code);
}

int reportUsageError(std::string_view Tool, std::string_view What) {
  return reportError(Tool, {"", fmt::format("{}, expected: see --help", What),
                            ExitCode::Usage});
}

void printText(std::string_view Text) {
  write(IsOutputTaken ? stderr : stdout, escapedLines(Text));
}

void printToStandardError() { IsOutputTaken = true; }

void printNote(std::string_view Text) { write(stderr, escapedLines(Text)); }

} // namespace vorion
