/// The compiler of OpenCL programs as a process that serves the driver
/// (CompilerMessages.h): the machine's compiler and linker.

#include "MachineCode.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Environment.h"
#include "vorion/support/HelpText.h"
#include "vorion/support/ServeCalls.h"
#include "vorion/support/Tool.h"
#include "vorion/support/Version.h"

#include "llvm/Support/raw_ostream.h"

#include <cstdlib>
#include <filesystem>
#include <string>

using namespace vorion;

namespace {

constexpr std::string_view Tool = "vorion-compiler";

constexpr std::string_view Usage =
    "usage: vorion-compiler --serve-calls | --version | --help\n"
    "\n"
    "Compiles kernels for OpenCL programs, which start it and send it "
    "messages\n"
    "over its standard input. vorion-clang compiles files.\n"
    "\n";

Response answer(std::string_view Text, const std::string &Bin) {
  ImageRequest Request;
  if (!isReadInto(Request, Text))
    return {{}, false};
  ImageAnswer Answer = makeImage(Request, Bin);
  llvm::outs().flush();
  llvm::errs().flush();
  Answer.Printed = takePrinted();
  return {textOf(Answer),
          // Options of LLVM are those of a process.
          Request.Options.empty() && !Answer.Image.empty()};
}

int run(int Argc, char **Argv) {
  const std::string_view Word = Argc == 2 ? Argv[1] : "";
  if (Word == "--help") {
    printHelp(fmt::format("{}{}\n", Usage, ExitCodeHelp));
    return 0;
  }
  if (Word == "--version") {
    printOut("{}\n", versionLine(Tool));
    return 0;
  }
  if (Word != ServeCalls)
    return reportUsageError(Tool, "expected --serve-calls");
  // LLVM would take an empty one for the folder that it is in.
  for (const char *Name : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"})
    if (!environmentVariable(Name))
      unsetenv(Name);
  std::error_code Failed;
  const std::string Bin =
      std::filesystem::read_symlink("/proc/self/exe", Failed)
          .parent_path()
          .string();
  return serveCalls(
      [&](std::string_view Request) { return answer(Request, Bin); });
}

} // namespace

int main(int Argc, char **Argv) {
  return runTool(Tool, [&] { return run(Argc, Argv); });
}
