#include "ClDiagnostics.h"
#include "ClCommandLine.h"

#include "vorion/support/ToolMessages.h"

#include <CL/cl_vorion.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

namespace vorion {

namespace {

constexpr const char *Wanted = ", expected OpenCL C that compiles";
constexpr const char *WantedModule = ", expected a valid module";
/// What the platform says of a kernel that it cannot make an image of, and how
/// its line ends before what the compiler printed.
constexpr std::string_view KernelRefused = "vorion: error: ";
constexpr std::string_view PrintedFollows = ", expected a kernel that can\n";
/// How the compiler's own lines begin, behind lld's.
constexpr std::string_view CompilerSays = "vorion-compiler: ";

std::vector<std::string> linesOf(const std::string &Text) {
  std::vector<std::string> Lines;
  std::istringstream Stream(Text);
  for (std::string Line; std::getline(Stream, Line);)
    Lines.push_back(Line);
  return Lines;
}

/// What stands in \p Text behind \p Words up to the end of the line.
std::optional<std::string> after(const std::string &Text,
                                 std::string_view Words) {
  const std::size_t At = Text.find(Words);
  if (At == std::string::npos)
    return std::nullopt;
  const std::size_t Begin = At + Words.size();
  return Text.substr(Begin, Text.find('\n', Begin) - Begin);
}

/// A cache that cannot be written is no fault of the source.
std::optional<Error> fileError(const std::string &Text) {
  const auto Problem = after(Text, CL_KERNEL_CACHE_PROBLEM_VORION);
  if (!Problem)
    return std::nullopt;
  return Error{"", *Problem, ExitCode::InputFile};
}

/// A compiler that gave no answer: the source may be good.
std::optional<Error> processError(const std::string &Input,
                                  const std::string &Text) {
  const auto Problem = after(Text, CompilerProblem);
  if (!Problem)
    return std::nullopt;
  return Error{Input, CompilerProblem + *Problem,
               Problem->starts_with("crashed") ? ExitCode::Internal
                                               : ExitCode::LimitReached};
}

} // namespace

Error compilerError(const std::string &Input, const std::string &Log,
                    const std::string &Output) {
  if (const auto Files = fileError(Log + Output))
    return *Files;
  if (const auto Process = processError(Input, Log + Output))
    return *Process;
  const std::vector<std::string> Lines = linesOf(Log);
  const auto Errors = std::ranges::count_if(Lines, [](const std::string &L) {
    return L.find(": error: ") != std::string::npos ||
           L.find(": fatal error: ") != std::string::npos;
  });
  if (Errors > 0)
    return {Input,
            (Errors == 1 ? "1 error" : std::to_string(Errors) + " errors") +
                std::string(Wanted)};
  if (const auto Symbol = after(Output, "Cannot find symbol "))
    return {Input, "undefined function " +
                       Symbol->substr(0, Symbol->find(' ')) +
                       ", expected its definition in the file"};
  if (const auto Variable = after(Output, "the variable "))
    return {Input, "undefined variable " +
                       Variable->substr(0, Variable->find(' ')) +
                       ", expected its definition in the file"};
  if (const auto Option = after(Output, "Invalid build option: "))
    return {"", *Option + ": unknown option, expected one of OpenCL C 1.2's",
            ExitCode::Usage};
  // A module that is not even a program is refused as kernels are.
  if (const auto Refused = after(Output, KernelRefused))
    return {Input, *Refused};
  const std::vector<std::string> Said = linesOf(Output);
  const auto First = std::ranges::find_if(
      Said, [](const std::string &Line) { return !Line.empty(); });
  return {Input, "does not compile" +
                     (First == Said.end() ? "" : " (" + *First + ")") +
                     (isSpirv(Input) ? WantedModule : Wanted)};
}

std::string machineLog(const std::string &Output) {
  const std::size_t Refused = Output.find(PrintedFollows);
  if (Refused == std::string::npos)
    return {};
  const std::size_t Begin = Output.find('\n', Refused);
  // The next kernel begins with a line of the platform.
  const std::size_t End = Output.find(KernelRefused, Begin);
  std::string Log = Output.substr(Begin + 1, End - Begin - 1);
  while (Log.ends_with("\n\n"))
    Log.pop_back();
  return Log;
}

std::string remarks(const std::string &Output) {
  std::string Found;
  for (const std::string &Line : linesOf(Output))
    if (Line.find(": remark: ") != std::string::npos)
      Found += Line + "\n";
  return Found;
}

Error optionError(const std::string &Output) {
  std::string Said = after(Output, "(LLVM option parsing): ").value_or("");
  if (Said.empty())
    return {"",
            "-march: " + after(Output, "error: ").value_or("does not work") +
                ", expected extensions as in "
                "rv32imaf_zicsr_zacas_xvortex_xvorion",
            ExitCode::Usage};
  // It advises a list that vorion-clang does not print.
  Said = Said.substr(0, Said.find(".  Try: "));
  return {"", "-mllvm: " + Said + ", expected an option that LLVM takes",
          ExitCode::Usage};
}

Error kernelError(const std::string &Input, const std::string &Output) {
  if (const auto Files = fileError(Output))
    return *Files;
  if (const auto Process = processError(Input, Output))
    return *Process;
  if (const auto Reason = after(Output, KernelRefused)) {
    if (Reason->find(", expected ") != std::string::npos)
      return {Input, *Reason};
    return {Input, *Reason + ", expected a kernel that can be compiled"};
  }
  return {Input, "no code was generated, expected at least one kernel"};
}

std::string linkerLog(const std::string &Output) {
  return Output.substr(0, Output.find(CompilerSays));
}

Error linkerError(const std::string &Image,
                  const std::vector<OfflineKernel> &Kernels,
                  const std::string &Output) {
  std::string Where = Image;
  std::size_t First = std::string::npos;
  for (const OfflineKernel &Kernel : Kernels)
    if (const std::size_t At = Output.find(Kernel.Name + ":("); At < First) {
      First = At;
      Where = Kernel.Name;
    }
  const auto Cause = after(Output, "error: ");
  // One of ours says itself what it expects.
  if (Cause && Cause->find(", expected ") != std::string::npos)
    return {Where, "cannot be linked: " + *Cause};
  return {Where, "cannot be linked" + (Cause ? " (" + *Cause + ")" : "") +
                     ", expected kernels that can be linked to one program"};
}

} // namespace vorion
