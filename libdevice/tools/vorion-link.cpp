/// The linker step of every program for the device: refuses objects that were
/// not compiled for XVortex. Then lld links the others with the device's
/// start-up code, linker script and library, and it writes into the program how
/// much of a stack each kernel needs. vorion-clang calls it as its linker, so
/// it takes lld's options.

#include "Lld.h"
#include "ObjectCheck.h"
#include "Program.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/HelpText.h"
#include "vorion/support/Tool.h"
#include "vorion/support/Version.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <sys/wait.h>
#include <unistd.h>

using namespace vorion;
namespace fs = std::filesystem;

namespace {

constexpr std::string_view Tool = "vorion-link";

constexpr std::string_view Usage =
    "usage: vorion-link [options] object... -o program.elf\n"
    "\n"
    "Links objects and archives for the Vorion device. Each must have been\n"
    "compiled for XVortex. The start-up code, the linker script and "
    "libdevice.a\n"
    "are added, unless -r (relocatable output) is given.\n"
    "\n"
    "Options are those of ld.lld; the common ones:\n"
    "  -o FILE    output (default a.out)\n"
    "  -L DIR     search DIR for -l\n"
    "  -l NAME    link libNAME.a\n"
    "  -r         relocatable output\n"
    "  -Map FILE  write a map of the program\n"
    "  --version  print the versions of this and of lld, and exit\n"
    "\n";

/// Options of lld whose value is the next argument, so that it is no input.
constexpr std::array<std::string_view, 17> TakesValue = {
    "-o",       "-m",      "-z",     "-e",      "--entry", "-T",
    "--script", "-Map",    "--Map",  "-u",      "-h",      "-soname",
    "--defsym", "-defsym", "-mllvm", "-plugin", "-y"};

struct CommandLine {
  std::vector<std::string> Forwarded;
  std::vector<std::string> Inputs; ///< files to check
  std::string Output = "a.out";
  bool Relocatable = false;
};

Expected<std::string> findLibrary(const std::string &Name,
                                  const std::vector<std::string> &Folders) {
  for (const std::string &Folder : Folders) {
    const fs::path Path = fs::path(Folder) / ("lib" + Name + ".a");
    if (fs::exists(Path))
      return Path.string();
  }
  return Error{"-l" + Name, "no such library, expected lib" + Name +
                                ".a in a folder given with -L"};
}

Expected<CommandLine> parse(int Argc, char **Argv) {
  CommandLine Line;
  std::vector<std::string> Folders, Libraries;
  for (int I = 1; I < Argc; ++I) {
    const std::string Arg = Argv[I];
    Line.Forwarded.push_back(Arg);
    if (Arg == "-L" || Arg == "-l" ||
        std::find(TakesValue.begin(), TakesValue.end(), Arg) !=
            TakesValue.end()) {
      if (++I == Argc)
        return Error{Arg, "expected a value after it", ExitCode::Usage};
      Line.Forwarded.emplace_back(Argv[I]);
      if (Arg == "-o")
        Line.Output = Argv[I];
      else if (Arg == "-L")
        Folders.emplace_back(Argv[I]);
      else if (Arg == "-l")
        Libraries.emplace_back(Argv[I]);
    } else if (Arg == "-r" || Arg == "--relocatable") {
      Line.Relocatable = true;
    } else if (Arg.starts_with("@")) {
      return Error{Arg,
                   "response files are not supported, expected options and "
                   "objects on the command line",
                   ExitCode::Usage};
    } else if (Arg.starts_with("-o") && Arg.size() > 2) {
      Line.Output = Arg.substr(2);
    } else if (Arg.starts_with("-L")) {
      Folders.push_back(Arg.substr(2));
    } else if (Arg.starts_with("-l")) {
      Libraries.push_back(Arg.substr(2));
    } else if (!Arg.starts_with("-")) {
      Line.Inputs.push_back(Arg);
    }
  }
  for (const std::string &Library : Libraries) {
    const auto Path = findLibrary(Library, Folders);
    if (!Path)
      return Path.error();
    Line.Inputs.push_back(*Path);
  }
  if (Line.Inputs.empty())
    return Error{"", "no input, expected objects (see --help)",
                 ExitCode::Usage};
  return Line;
}

/// lld in a copy of this process, which a signal may end.
Expected<Success> runLinker(const std::vector<std::string> &Arguments) {
  const pid_t Child = fork();
  if (Child < 0)
    return Error{"", fmt::format("cannot start the linker: {}, expected a host "
                                 "with room for a process",
                                 std::strerror(errno))};
  if (Child == 0)
    link::runLld(Arguments);
  int Status = 0;
  while (waitpid(Child, &Status, 0) < 0 && errno == EINTR) {
  }
  // It writes through a map, which a full disk ends by this signal.
  if (WIFSIGNALED(Status) && WTERMSIG(Status) == SIGBUS)
    return Error{
        "", "ld.lld-19 could not write its output, expected free disk space"};
  if (!WIFEXITED(Status) || WEXITSTATUS(Status) != 0)
    return Error{"", "the link failed, expected no errors of ld.lld-19 (see "
                     "its messages above)"};
  return Success{};
}

/// Completes the kernel table of \p Output.
Expected<Success> addStackNeeds(const std::string &Output) {
  std::error_code Failed;
  if (!fs::is_regular_file(Output, Failed))
    return Success{};
  Expected<std::vector<std::byte>> Program = readFile(Output);
  if (!Program)
    return Program.error();
  if (const auto Completed = link::completeProgram(*Program, Tool, Output);
      !Completed)
    return Completed;
  std::fstream File(Output, std::ios::in | std::ios::out | std::ios::binary);
  File.write(reinterpret_cast<const char *>(Program->data()),
             static_cast<std::streamsize>(Program->size()));
  File.close();
  if (!File)
    return Error{Output, "cannot be written, expected free disk space"};
  return Success{};
}

Expected<Success> linkProgram(const CommandLine &Line) {
  for (const std::string &Input : Line.Inputs) {
    const auto Bytes = readFile(Input);
    if (!Bytes)
      return Bytes.error();
    const auto Good = link::checkInput(*Bytes, Input);
    if (!Good)
      return Good.error();
  }
  std::vector<std::string> Arguments = {link::LinkerName};
  if (Line.Relocatable) {
    Arguments.insert(Arguments.end(), Line.Forwarded.begin(),
                     Line.Forwarded.end());
  } else {
    auto Program = link::programArguments(Line.Forwarded);
    if (!Program)
      return Program.error();
    Arguments = std::move(*Program);
  }

  // lld leaves its old output in place when it fails half way, and writes
  // through a file of its own, so the name is safe to give to it.
  if (const Expected<Success> Linked = runLinker(Arguments);
      !Linked || Line.Relocatable)
    return Linked;
  return addStackNeeds(Line.Output);
}

int run(int Argc, char **Argv) {
  for (int I = 1; I < Argc; ++I)
    if (std::strcmp(Argv[I], "--help") == 0) {
      printHelp(fmt::format("{}{}\n", Usage, ExitCodeHelp));
      return 0;
    } else if (std::strcmp(Argv[I], "--version") == 0) {
      printOut("{}\n", versionLine(Tool));
      std::fflush(stdout);
      // Build systems look for lld's name to know what options there are.
      const auto Shown = runLinker({link::LinkerName, "--version"});
      return Shown ? 0 : reportError(Tool, Shown.error());
    }
  const auto Line = parse(Argc, Argv);
  if (!Line)
    return reportError(Tool, Line.error());
  const auto Linked = linkProgram(*Line);
  return Linked ? 0 : reportError(Tool, Linked.error());
}

} // namespace

int main(int Argc, char **Argv) {
  return runTool(Tool, [&] { return run(Argc, Argv); });
}
