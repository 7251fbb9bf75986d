/// Files of OpenCL C and of SPIR-V to one image with all their kernels: what
/// vorion-clang runs when it is given nothing but .cl and .spv files and is
/// asked for a program.
///
/// PoCL's library compiles each kernel for any group size (or the one that
/// reqd_work_group_size gives) as it does for a program of OpenCL, and links
/// their objects (vorion_offline.h). All of it stays in memory.

#include "ClCommandLine.h"
#include "ClDiagnostics.h"

#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/HelpText.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Tool.h"
#include "vorion/support/Version.h"

#include <vorion_offline.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
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
    "  -v                     print the version and the compiler that is run\n"
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
    "  --explorer             show source, LLVM IR, machine code and cycles in "
    "one page that\n"
    "                         follows the file (vorion-clang --explorer "
    "--help)\n"
    "\n";

std::string textOf(const fs::path &File) {
  std::ifstream Stream(File, std::ios::binary);
  return {std::istreambuf_iterator<char>(Stream), {}};
}

/// Kernels by name.
using Kernels = std::map<std::string, OfflineKernel>;

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

/// The compiler of the installation in \p Root.
Expected<OfflineCompiler *> openCompiler(const fs::path &Root) {
  const fs::path File = Root / "pocl/lib/libvorion-pocl.so";
  void *Library = dlopen(File.c_str(), RTLD_NOW | RTLD_LOCAL);
  void *Function = Library ? dlsym(Library, OfflineCompilerFunction) : nullptr;
  if (!Function)
    return Error{File.string(),
                 std::string(dlerror()) +
                     ", expected the library of this build",
                 ExitCode::Internal};
  return reinterpret_cast<OfflineCompilerOf *>(Function)();
}

Expected<Success> keep(const fs::path &File, const std::string &Bytes) {
  return writeFileAtomically(File.string(), Bytes.data(), Bytes.size());
}

/// -save-temps: writes what was made of \p Kernel into \p Folder.
Expected<Success> keepTemporaries(const OfflineKernel &Kernel,
                                  const fs::path &Folder) {
  const auto Kept = keep(Folder / (Kernel.Name + ".bc"), Kernel.Bitcode);
  return Kept ? keep(Folder / (Kernel.Name + ".o"), Kernel.Object) : Kept;
}

/// The image, which can be executed as those of lld can.
Expected<Success> writeImage(const fs::path &File, const std::string &Image) {
  const auto Written = keep(File, Image);
  std::error_code Ignored;
  using fs::perms;
  if (Written && fs::is_regular_file(File, Ignored))
    fs::permissions(File,
                    perms::owner_exec | perms::group_exec | perms::others_exec,
                    fs::perm_options::add, Ignored);
  return Written;
}

/// Compiles one input.
Expected<Kernels> compileOne(const ClCommandLine &Line, const fs::path &Input,
                             OfflineCompiler &Compiler) {
  const Expected<std::string> Beside =
      includeOption((Input.parent_path() / ".").string());
  if (!Beside)
    return Beside.error();
  OfflineProgram Program;
  Program.IsSpirv = isSpirv(Input);
  Program.Options = Line.BuildOptions + *Beside;
  Program.WantsBitcode = Line.Temporaries.has_value();
  // The compiler sees text without a name, so the text names its origin, for
  // messages and debuggers; headers beside the file are found by its folder.
  if (!Program.IsSpirv)
    Program.Text = "#line 1 \"<command line>\"\n" + Line.Prelude + "#line 1 " +
                   quoted(Input.string()) + "\n";
  Program.Text += textOf(Input);
  OfflineAnswer Answer = Compiler.compile(Program);
  // Errors and warnings as clang prints them: with lines, carets and notes.
  // What PoCL's linker says of them follows, and is said below.
  if (!Program.IsSpirv)
    std::cerr << Answer.Log.substr(0, Answer.Log.find("Error(s) while linking"))
              << std::flush;
  if (!Answer.IsBuilt)
    return compilerError(Input.string(), Answer.Log, Answer.Printed);
  std::cerr << machineLog(Answer.Printed)
            << (Line.ForMachine.empty() ? "" : remarks(Answer.Printed))
            << std::flush;
  if (!Answer.IsWhole || Answer.Kernels.empty())
    return kernelError(Input.string(), Answer.Printed);
  Kernels ByName;
  for (OfflineKernel &Kernel : Answer.Kernels)
    ByName.emplace(Kernel.Name, std::move(Kernel));
  return ByName;
}

Expected<Success> compile(const ClCommandLine &Line, const fs::path &Root) {
  for (const fs::path &Input : Line.Inputs)
    if (const Expected<Success> Good = checkInput(Input); !Good)
      return Good;
  if (const Expected<Success> Good = claimOutput(Line); !Good)
    return Good;
  setenv("VORION_ROOT", Root.c_str(), 1);
  if (!Line.ForMachine.empty()) {
    std::ostringstream Words;
    for (const std::string &Word : Line.ForMachine)
      Words << std::quoted(Word) << ' ';
    setenv("VORION_REMARKS", Words.str().c_str(), 1);
  }
  const Expected<OfflineCompiler *> Opened = openCompiler(Root);
  if (!Opened)
    return Opened.error();
  OfflineCompiler &Compiler = **Opened;
  if (Line.Verbose)
    std::cerr << versionLine(Tool) << "\n " << Compiler.commandLine() << '\n';
  // Options that the machine's compiler does not take are refused before any
  // kernel is blamed.
  if (std::string Printed;
      !Line.ToCheck.empty() && !Compiler.areOptions(Printed))
    return optionError(Printed);

  std::vector<OfflineKernel> Objects;
  std::map<std::string, std::string> Owners;
  // As clang does, all files are compiled, whatever is wrong with the first.
  std::optional<Error> Failed;
  for (const fs::path &File : Line.Inputs) {
    const std::string Input = File.string();
    Expected<Kernels> Found = compileOne(Line, File, Compiler);
    if (!Found) {
      if (Failed)
        reportError(Tool, *Failed);
      Failed = Found.error();
      continue;
    }
    for (auto &[Name, Kernel] : *Found) {
      const auto [Owner, New] = Owners.emplace(Name, Input);
      if (!New)
        return Error{Input, "kernel " + Name + " is also in " + Owner->second +
                                ", expected kernels with different names"};
      if (Line.Temporaries)
        if (const auto Kept = keepTemporaries(Kernel, *Line.Temporaries); !Kept)
          return Kept.error();
      Kernel.Name = fmt::format("{}: kernel {}", Input, Name);
      Objects.push_back(std::move(Kernel));
    }
  }
  if (Failed)
    return *Failed;
  std::string Printed;
  const std::string Image = Compiler.link(Objects, Printed);
  if (Image.empty()) {
    std::cerr << linkerLog(Printed) << std::flush;
    return linkerError(Line.Output.string(), Objects, Printed);
  }
  std::cerr << Printed << std::flush;
  return writeImage(Line.Output, Image);
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
  std::error_code Problem;
  const fs::path Root =
      fs::read_symlink("/proc/self/exe", Problem).parent_path().parent_path();
  const Expected<ClCommandLine> Line =
      parseClCommandLine({Argv + 1, Argv + Argc});
  if (!Line)
    return reportError(Tool, Line.error());
  const Expected<Success> Done = compile(*Line, Root);
  return Done ? 0 : reportError(Tool, Done.error());
}

} // namespace

int main(int Argc, char **Argv) {
  return runTool(Tool, [&] { return run(Argc, Argv); });
}
