#include "ClDiagnostics.h"

#include <optional>
#include <regex>
#include <sstream>
#include <string_view>

namespace vorion {

namespace {

/// Longer lines are cut: std::regex needs stack for every character.
constexpr size_t MaxLine = 2000;

std::vector<std::string> linesOf(const std::string &Text) {
  std::vector<std::string> Lines;
  std::istringstream Stream(Text);
  for (std::string Line; std::getline(Stream, Line);)
    Lines.push_back(Line.substr(0, MaxLine));
  return Lines;
}

/// "SEVERITY: file:1:2: words" as PoCL writes it; where a macro is at fault its
/// own place follows the first in angle brackets, which we leave out.
std::optional<Error> parse(const std::string &Line, std::string_view Severity) {
  static const std::regex Form(
      "(error|warning): (.*?:[0-9]+:[0-9]+)( <Spelling=.*?>)?: (.*)");
  std::smatch Parts;
  if (!std::regex_match(Line, Parts, Form) || Parts.str(1) != Severity)
    return std::nullopt;
  return Error{Parts.str(2), Parts.str(4)};
}

} // namespace

std::vector<Error> compilerWarnings(const std::string &Log) {
  std::vector<Error> Warnings;
  for (const std::string &Line : linesOf(Log))
    if (const std::optional<Error> Warning = parse(Line, "warning"))
      Warnings.push_back(*Warning);
  return Warnings;
}

Error compilerError(const std::string &Input, const std::string &Output) {
  static const std::regex Counts("[0-9]+ (warning|error)s?.* generated\\.");
  static const std::regex Symbol("Cannot find symbol (.*) in kernel library");
  static const std::regex Option("Invalid build option: (.*)");
  constexpr const char *Wanted = ", expected OpenCL C that compiles";
  std::string FirstWords;
  for (const std::string &Line : linesOf(Output)) {
    std::smatch Parts;
    if (std::optional<Error> Found = parse(Line, "error")) {
      Found->What += Wanted;
      return *Found;
    }
    if (std::regex_match(Line, Parts, Symbol))
      return {Input, "there is no function " + Parts.str(1) +
                         ", expected its definition in the file"};
    if (std::regex_match(Line, Parts, Option))
      return {"",
              Parts.str(1) + ": unknown option, expected one of OpenCL C 1.2's",
              ExitCode::Usage};
    if (FirstWords.empty() && !Line.empty() && !parse(Line, "warning") &&
        !std::regex_match(Line, Counts))
      FirstWords = Line;
  }
  return {Input, "does not compile" +
                     (FirstWords.empty() ? "" : " (" + FirstWords + ")") +
                     Wanted};
}

Error linkerError(const std::string &Image, const std::string &Output) {
  std::string Cause;
  for (const std::string &Line : linesOf(Output)) {
    const size_t At = Line.find("error: ");
    if (At == std::string::npos)
      continue;
    Cause = " (" + Line.substr(At + std::string_view("error: ").size()) + ")";
    break;
  }
  return {Image, "cannot be linked" + Cause +
                     ", expected kernels that make one program"};
}

} // namespace vorion
