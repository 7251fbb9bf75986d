/// Files of OpenCL C and of SPIR-V to one image with all their kernels: what
/// vorion-clang runs when it is given nothing but .cl and .spv files and is
/// asked for a program.
///
/// PoCL's offline compiler builds each file for any group size (or the one that
/// reqd_work_group_size gives) and leaves an object a kernel in its cache, here
/// a folder of our own; vorion-link makes one image of them.

#include "ChildProcess.h"
#include "ClCommandLine.h"
#include "ClDiagnostics.h"

#include "vorion/support/Diagnostics.h"
#include "vorion/support/HelpText.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/TemporaryFolder.h"
#include "vorion/support/Tool.h"
#include "vorion/support/Version.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

using namespace vorion;
namespace fs = std::filesystem;

namespace {

constexpr std::string_view Tool = "vorion-clang";

constexpr std::string_view Usage =
    "usage: vorion-clang [options] (kernel.cl | kernel.spv)... [-o "
    "program.elf]\n"
    "\n"
    "Compiles OpenCL C and SPIR-V for the Vorion device: one image with all "
    "kernels, for\n"
    "any work-group size (docs/abi.md). With -c, -S, -E or -emit-llvm it is "
    "clang.\n"
    "\n"
    "  -o FILE                the image (default: the first input's name with "
    ".elf)\n"
    "  -D NAME[=TEXT], -U NAME, -I FOLDER\n"
    "                         macros, and where headers are, as of clang\n"
    "  -g                     with line numbers\n"
    "  -w, -Werror, -W[no-|error=]NAME\n"
    "                         warnings, as of clang\n"
    "  -cl-...                options of OpenCL C\n"
    "  -O0                    variables stay where a debugger finds them, but "
    "in kernels\n"
    "                         with barriers\n"
    "  -O1 to -O3, -Os, -Oz   accepted; otherwise kernels are compiled with "
    "-O2\n"
    "  -Ofast, -ffast-math    the same as -cl-fast-relaxed-math\n"
    "  -v                     print the programs that are run\n"
    "  -save-temps[=cwd|obj]  keep KERNEL.bc and KERNEL.o of each kernel, in "
    "this folder\n"
    "                         or beside the image; 'vorion-llc -mcpu=vorion' "
    "compiles\n"
    "                         the .bc, which has the loops over work-items\n"
    "  -Rpass=REGEX, -Rpass-missed=REGEX, -Rpass-analysis=REGEX\n"
    "                         what the compiler did, could not do, and why: "
    "'vorion' for\n"
    "                         what concerns lanes (docs/backend.md)\n"
    "  -mllvm OPTION          an option of LLVM's, for the machine's compiler "
    "(docs/backend.md)\n"
    "  -march=EXTENSIONS      compile for these alone, as "
    "rv32imaf_zicsr_zacas_xvortex_xvorion\n"
    "  --resources[=json|FILE]\n"
    "                         print what each function takes: registers, "
    "spills, stack,\n"
    "                         divergent branches and why; as a table, or as "
    "JSON to\n"
    "                         standard output or FILE\n"
    "\n";

std::string textOf(const fs::path &File) {
  std::ifstream Stream(File, std::ios::binary);
  return {std::istreambuf_iterator<char>(Stream), {}};
}

/// What PoCL left in its cache for one file.
struct Built {
  /// A kernel's name to its object.
  std::map<std::string, std::string> Objects;
  /// Whether a kernel was not compiled: the innermost folder has no object.
  bool Missing = false;
  /// What the compiler said.
  std::string Log;
};

/// An object lies in each innermost folder.
Expected<Built> findBuilt(const fs::path &Cache) {
  Built Found;
  std::error_code Problem;
  fs::recursive_directory_iterator Entry(Cache, Problem);
  for (; !Problem && Entry != fs::recursive_directory_iterator();
       Entry.increment(Problem)) {
    if (Entry->path().filename() == "build.log")
      Found.Log += textOf(Entry->path());
    if (!Entry->is_directory(Problem) || Problem)
      continue;
    bool Innermost = true;
    fs::path Object;
    fs::directory_iterator Inside(Entry->path(), Problem);
    for (; !Problem && Inside != fs::directory_iterator();
         Inside.increment(Problem)) {
      Innermost &= !Inside->is_directory(Problem);
      if (Inside->path().extension() == ".o")
        Object = Inside->path();
    }
    if (!Innermost || Entry->path().filename() == "tempfiles")
      continue;
    if (Object.empty())
      Found.Missing = true;
    else
      Found.Objects[Object.stem().string()] = Object.string();
  }
  if (Problem)
    return Error{Cache.string(), "cannot be read: " + Problem.message() +
                                     ", expected a folder of compiled kernels"};
  return Found;
}

/// Refuses an output that could not be written, before any work is done.
Expected<Success> claimOutput(const ClCommandLine &Line) {
  std::vector<NamedFile> Inputs;
  Inputs.reserve(Line.Inputs.size());
  for (const fs::path &Input : Line.Inputs)
    Inputs.push_back({"an input", Input.string()});
  return claimOutputs({{"-o", Line.Output.string()}}, Inputs);
}

Expected<Success> checkInput(const fs::path &Input) {
  std::error_code Problem;
  if (fs::is_directory(Input, Problem))
    return Error{Input.string(), "is a folder, expected OpenCL source"};
  if (access(Input.c_str(), R_OK) != 0)
    return Error{Input.string(), std::string(std::strerror(errno)) +
                                     ", expected OpenCL source"};
  return Success{};
}

/// \p Name as a C string literal.
std::string quoted(const std::string &Name) {
  std::string Text = "\"";
  for (const char C : Name)
    Text += C == '"' || C == '\\' ? std::string{'\\', C} : std::string{C};
  return Text + "\"";
}

/// With -v, runs as runChild() does and says what.
Ran runStep(const ClCommandLine &Line,
            const std::vector<std::string> &Arguments) {
  if (Line.Verbose) {
    for (const std::string &Argument : Arguments)
      std::cerr << ' ' << quoted(Argument);
    std::cerr << '\n';
  }
  return runChild(Arguments);
}

/// -save-temps: copies what was made of \p Kernel into \p Folder.
Expected<Success> keepTemporaries(const std::string &Kernel,
                                  const fs::path &Object,
                                  const fs::path &Folder) {
  std::error_code Problem;
  for (const auto &Made : fs::directory_iterator(Object.parent_path())) {
    const fs::path Kind = Made.path().extension();
    if (Kind != ".bc" && Kind != ".o")
      continue;
    const fs::path Copy = Folder / (Kernel + Kind.string());
    fs::copy_file(Made.path(), Copy, fs::copy_options::overwrite_existing,
                  Problem);
    if (Problem)
      return Error{Copy.string(),
                   "cannot be written: " + Problem.message() +
                       ", expected a writable location for -save-temps"};
  }
  return Success{};
}

/// Refuses options that the machine's compiler does not take, before any kernel
/// is blamed.
Expected<Success> checkOptions(const ClCommandLine &Line,
                               const fs::path &Root) {
  if (Line.ToCheck.empty())
    return Success{};
  std::vector<std::string> Arguments = {(Root / "bin/vorion-clang").string(),
                                        "-x", "c", "-fsyntax-only",
                                        "/dev/null"};
  Arguments.insert(Arguments.end(), Line.ToCheck.begin(), Line.ToCheck.end());
  const Ran Compiler = runStep(Line, Arguments);
  return Compiler.Succeeded ? Expected<Success>(Success{})
                            : optionError(Compiler.Output);
}

/// Compiles one input with everything PoCL makes of it in \p Folder.
Expected<Built> compileOne(const ClCommandLine &Line, const fs::path &Input,
                           const fs::path &Root, const fs::path &Folder) {
  std::error_code Problem;
  const fs::path Cache = Folder / "cache";
  fs::create_directories(Cache, Problem);
  setenv("VORION_KERNEL_FOLDER", Cache.c_str(), 1);
  // The compiler sees text without a name, so a copy names its origin, for
  // messages and debuggers; headers beside the file are found by its folder.
  const fs::path Copy = Folder / "input";
  std::ofstream Writer(Copy, std::ios::binary);
  if (!isSpirv(Input))
    Writer << "#line 1 \"<command line>\"\n"
           << Line.Prelude << "#line 1 " << quoted(Input.string()) << "\n";
  Writer << textOf(Input);
  Writer.close();
  if (!Writer)
    return Error{Copy.string(),
                 "cannot be written, expected room for a copy of " +
                     Input.string()};
  const Expected<std::string> Beside =
      includeOption((Input.parent_path() / ".").string());
  if (!Beside)
    return Beside.error();
  std::vector<std::string> Arguments = {(Root / "pocl/bin/poclcc").string(),
                                        "-b", Line.BuildOptions + *Beside, "-o",
                                        (Folder / "binary").string()};
  if (isSpirv(Input))
    Arguments.emplace_back("-s");
  Arguments.push_back(Copy.string());
  const Ran Compiler = runStep(Line, Arguments);
  Expected<Built> Found = findBuilt(Cache);
  if (!Found)
    return Found;
  // Errors and warnings as clang prints them: with lines, carets and notes.
  // What PoCL's linker says of them follows, and is said below.
  std::cerr << Found->Log.substr(0, Found->Log.find("Error(s) while linking"))
            << std::flush;
  if (Compiler.Signal != 0)
    return Error{Input.string(),
                 std::string("the compiler crashed (") +
                     strsignal(Compiler.Signal) +
                     "), expected an image or errors in the file",
                 ExitCode::Internal};
  if (!Compiler.Succeeded)
    return compilerError(Input.string(), Found->Log, Compiler.Output);
  std::cerr << machineLog(Compiler.Output)
            << (Line.ForMachine.empty() ? "" : remarks(Compiler.Output))
            << std::flush;
  if (Found->Missing)
    return kernelError(Input.string(), Compiler.Output);
  if (Found->Objects.empty())
    return Error{Input.string(), "no kernel, expected at least one"};
  return Found;
}

Expected<Success> compile(const ClCommandLine &Line, const fs::path &Root) {
  for (const fs::path &Input : Line.Inputs)
    if (const Expected<Success> Good = checkInput(Input); !Good)
      return Good;
  if (const Expected<Success> Good = claimOutput(Line); !Good)
    return Good;
  if (const Expected<Success> Good = checkOptions(Line, Root); !Good)
    return Good;
  const auto Folder = TemporaryFolder::make("vorion");
  if (!Folder)
    return Folder.error();
  // The loader takes a library here, too: no path is written anywhere.
  setenv("OCL_ICD_VENDORS", (Root / "pocl/lib/libvorion-pocl.so").c_str(), 1);
  setenv("VORION_ROOT", Root.c_str(), 1);
  // The device's driver compiles kernels that nobody has started, too.
  setenv("VORION_COMPILE_ALL", "1", 1);
  if (Line.Temporaries)
    setenv("POCL_LEAVE_KERNEL_COMPILER_TEMP_FILES", "1", 1);
  if (Line.Verbose)
    std::cerr << versionLine(Tool) << '\n';
  if (!Line.ForMachine.empty()) {
    std::ostringstream Words;
    for (const std::string &Word : Line.ForMachine)
      Words << std::quoted(Word) << ' ';
    setenv("VORION_REMARKS", Words.str().c_str(), 1);
  }

  std::vector<std::string> Link = {(Root / "bin/vorion-link").string(), "-o",
                                   Line.Output.string()};
  std::map<std::string, std::string> Owners;
  // As clang does, all files are compiled, whatever is wrong with the first.
  std::optional<Error> Failed;
  for (size_t I = 0; I < Line.Inputs.size(); ++I) {
    const std::string Input = Line.Inputs[I].string();
    const Expected<Built> Found =
        compileOne(Line, Line.Inputs[I], Root,
                   fs::path(Folder->path()) / std::to_string(I));
    if (isEnding())
      return Success{};
    if (!Found) {
      if (Failed)
        reportError(Tool, *Failed);
      Failed = Found.error();
      continue;
    }
    for (const auto &[Kernel, Object] : Found->Objects) {
      const auto [Owner, New] = Owners.emplace(Kernel, Input);
      if (!New)
        return Error{Input, "kernel " + Kernel + " is also in " +
                                Owner->second +
                                ", expected kernels with different names"};
      if (Line.Temporaries)
        if (const auto Kept =
                keepTemporaries(Kernel, Object, *Line.Temporaries);
            !Kept)
          return Kept.error();
      Link.push_back(Object);
    }
  }
  if (Failed)
    return *Failed;
  const Ran Linker = runStep(Line, Link);
  if (!Linker.Succeeded)
    return linkerError(Line.Output.string(), Linker.Output);
  std::cerr << Linker.Output << std::flush;
  return Success{};
}

int run(int Argc, char **Argv) {
  if (Argc == 2 && !std::strcmp(Argv[1], "--help")) {
    printHelp(fmt::format("{}{}\n", Usage, ExitCodeHelp));
    return 0;
  }
  if (Argc == 2 && !std::strcmp(Argv[1], "--version")) {
    printOut("{}\n", versionLine("vorion-cl-link"));
    return 0;
  }
  passEndsToChildren();
  std::error_code Problem;
  const fs::path Root =
      fs::read_symlink("/proc/self/exe", Problem).parent_path().parent_path();
  const Expected<ClCommandLine> Line =
      parseClCommandLine({Argv + 1, Argv + Argc});
  if (!Line)
    return reportError(Tool, Line.error());
  const Expected<Success> Done = compile(*Line, Root);
  endIfAsked();
  return Done ? 0 : reportError(Tool, Done.error());
}

} // namespace

int main(int Argc, char **Argv) {
  return runTool(Tool, [&] { return run(Argc, Argv); });
}
