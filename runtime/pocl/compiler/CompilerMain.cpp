/// The compiler of OpenCL programs as a process that serves the driver
/// (CompilerMessages.h): PoCL's front end and passes (ProgramServer.h), the
/// translator of SPIR-V, and the machine's compiler and linker (MachineCode.h).

#include "ProgramServer.h"
#include "SpirvTranslator.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Environment.h"
#include "vorion/support/HelpText.h"
#include "vorion/support/ServeCalls.h"
#include "vorion/support/Tool.h"
#include "vorion/support/ToolMessages.h"
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

/// What was printed, by LLVM's streams too.
std::string allPrinted() {
  llvm::outs().flush();
  llvm::errs().flush();
  return takePrinted();
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
  const std::filesystem::path Bin =
      std::filesystem::read_symlink("/proc/self/exe", Failed).parent_path();
  const CompilerSteps Steps = {translateSpirv,
                               [&](const MachineRequest &Request) {
                                 return makeImage(Request, Bin.string());
                               },
                               linkObjects,
                               [&](const std::vector<std::string> &Options) {
                                 return areOptions(Options, Bin.string());
                               }};
  return serveCalls([&](std::string_view Request) {
    Response Given;
    Given.Text = answerProgramRequest(Request, Bin.parent_path().string(),
                                      Steps, allPrinted, Given.MayStay);
    return Given;
  });
}

} // namespace

int main(int Argc, char **Argv) {
  return runTool(Tool, [&] { return run(Argc, Argv); });
}
