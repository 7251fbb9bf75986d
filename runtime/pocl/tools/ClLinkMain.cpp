/// OpenCL C files to one image with all their kernels: what vorion-clang runs when
/// it is given nothing but .cl files and is asked for a program.
///
/// PoCL's offline compiler builds each file for any group size (or the one that
/// reqd_work_group_size gives) and leaves an object a kernel in its cache, here a
/// folder of our own; vorion-link makes one image of them.

#include "vorion/support/Diagnostics.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char **environ;

using namespace vorion;
namespace fs = std::filesystem;

namespace {

constexpr std::string_view Tool = "vorion-clang";

constexpr std::string_view Usage =
    "usage: vorion-clang [options] kernel.cl... [-o program.elf]\n"
    "\n"
    "Compiles OpenCL C 1.2 for the Vorion device: one image with all kernels, for\n"
    "any work-group size (docs/abi.md). With -c, -S, -E or -emit-llvm it is clang.\n"
    "\n"
    "  -o FILE       the image (default: the first input's name with .elf)\n"
    "  -D, -U, -I, -cl-... and other options of the OpenCL C compiler\n"
    "\n";

struct CommandLine {
  std::vector<fs::path> Inputs;
  std::string BuildOptions;
  fs::path Output;
};

bool isKernelFile(const fs::path &Path) { return Path.extension() == ".cl"; }

Expected<CommandLine> parse(int Argc, char **Argv) {
  CommandLine Line;
  const auto UsageError = [](std::string What) {
    return Error{"", std::move(What), ExitCode::Usage};
  };
  for (int I = 1; I < Argc; ++I) {
    const std::string Argument = Argv[I];
    if (Argument == "-o") {
      if (++I == Argc)
        return UsageError("-o: expected a file name");
      Line.Output = Argv[I];
    } else if (Argument.starts_with("-")) {
      Line.BuildOptions += Argument + " ";
      if ((Argument == "-D" || Argument == "-I" || Argument == "-U") &&
          I + 1 < Argc)
        Line.BuildOptions += std::string(Argv[++I]) + " ";
    } else if (isKernelFile(Argument)) {
      Line.Inputs.emplace_back(Argument);
    } else {
      return UsageError(Argument + ": expected a .cl file");
    }
  }
  if (Line.Inputs.empty())
    return UsageError("no input, expected a .cl file");
  if (Line.Output.empty())
    Line.Output = Line.Inputs[0].filename().replace_extension(".elf");
  return Line;
}

/// A folder that goes when its user does.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string Template = (fs::temp_directory_path() / "vorion-XXXXXX").string();
    if (mkdtemp(Template.data()))
      Path = Template;
  }
  ~TemporaryFolder() {
    std::error_code Ignored;
    if (!Path.empty())
      fs::remove_all(Path, Ignored);
  }
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;

  fs::path Path;
};

/// Runs a program, its standard output joined to standard error; true if it
/// succeeded.
bool run(const std::vector<std::string> &Arguments) {
  std::vector<char *> Pointers;
  for (const std::string &Argument : Arguments)
    Pointers.push_back(const_cast<char *>(Argument.c_str()));
  Pointers.push_back(nullptr);
  posix_spawn_file_actions_t Actions;
  posix_spawn_file_actions_init(&Actions);
  posix_spawn_file_actions_adddup2(&Actions, STDERR_FILENO, STDOUT_FILENO);
  pid_t Child = 0;
  const int Problem = posix_spawn(&Child, Pointers[0], &Actions, nullptr,
                                  Pointers.data(), environ);
  posix_spawn_file_actions_destroy(&Actions);
  int Status = 0;
  return Problem == 0 && waitpid(Child, &Status, 0) == Child &&
         WIFEXITED(Status) && WEXITSTATUS(Status) == 0;
}

/// The objects that PoCL left, one in each innermost folder. A folder without
/// one is a kernel that was not compiled.
Expected<std::vector<std::string>> findObjects(const fs::path &Cache,
                                               const std::string &Input) {
  std::vector<std::string> Objects;
  for (const auto &Entry : fs::recursive_directory_iterator(Cache)) {
    if (!Entry.is_directory())
      continue;
    bool Innermost = true;
    std::string Object;
    for (const auto &Inside : fs::directory_iterator(Entry)) {
      Innermost &= !Inside.is_directory();
      if (Inside.path().extension() == ".o")
        Object = Inside.path().string();
    }
    if (!Innermost || Entry.path().filename() == "tempfiles")
      continue;
    if (Object.empty())
      return Error{Input, "no code was made of a kernel, or there is none",
                   ExitCode::InputFile};
    Objects.push_back(Object);
  }
  if (Objects.empty())
    return Error{Input, "there is no kernel in it", ExitCode::InputFile};
  std::sort(Objects.begin(), Objects.end());
  return Objects;
}

Expected<Success> compile(const CommandLine &Line, const fs::path &Root) {
  TemporaryFolder Folder;
  if (Folder.Path.empty())
    return Error{"", std::string("cannot make a temporary folder: ") +
                         std::strerror(errno)};
  setenv("OCL_ICD_VENDORS", (Root / "etc/OpenCL/vendors").c_str(), 1);
  setenv("VORION_ROOT", Root.c_str(), 1);

  std::vector<std::string> Link = {(Root / "bin/vorion-link").string(), "-o",
                                   Line.Output.string()};
  for (size_t I = 0; I < Line.Inputs.size(); ++I) {
    const fs::path &Input = Line.Inputs[I];
    if (access(Input.c_str(), R_OK) != 0)
      return Error{Input.string(), std::strerror(errno)};
    const fs::path Cache = Folder.Path / std::to_string(I);
    fs::create_directory(Cache);
    setenv("POCL_CACHE_DIR", Cache.c_str(), 1);
    // The compiler sees text without a name, so a copy names its origin, for
    // messages and debuggers; headers beside the file are found by its folder.
    const fs::path Copy = Folder.Path / "input.cl";
    std::ifstream Source(Input, std::ios::binary);
    std::ofstream(Copy, std::ios::binary)
        << "#line 1 \"" << Input.string() << "\"\n" << Source.rdbuf();
    const std::string Beside = fs::absolute(Input).parent_path().string();
    if (!run({(Root / "pocl/bin/poclcc").string(), "-b",
              Line.BuildOptions + "-I\"" + Beside + "\"", "-o",
              (Folder.Path / "binary").string(), Copy.string()}))
      return Error{Input.string(), "does not compile"};
    Expected<std::vector<std::string>> Objects = findObjects(Cache, Input.string());
    if (!Objects)
      return Objects.error();
    Link.insert(Link.end(), Objects->begin(), Objects->end());
  }
  if (!run(Link))
    return Error{Line.Output.string(), "cannot be linked"};
  return Success{};
}

} // namespace

int main(int Argc, char **Argv) {
  if (Argc == 2 && !std::strcmp(Argv[1], "--help")) {
    std::cout << Usage << ExitCodeHelp << "\n";
    return 0;
  }
  std::error_code Problem;
  const fs::path Root =
      fs::read_symlink("/proc/self/exe", Problem).parent_path().parent_path();
  const Expected<CommandLine> Line = parse(Argc, Argv);
  if (!Line)
    return reportError(Tool, Line.error());
  const Expected<Success> Done = compile(*Line, Root);
  return Done ? 0 : reportError(Tool, Done.error());
}
