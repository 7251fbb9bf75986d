#include "MachineCode.h"

#include "Lld.h"
#include "MemoryFile.h"
#include "ObjectCheck.h"
#include "Program.h"
#include "vorion/support/Diagnostics.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/VirtualFileSystem.h"

#include "clang/Basic/DiagnosticOptions.h"
#include "clang/Driver/Compilation.h"
#include "clang/Driver/Driver.h"
#include "clang/Driver/ToolChain.h"
#include "clang/Frontend/TextDiagnosticPrinter.h"
#include "llvm/Support/LLVMDriver.h"
#include "llvm/Support/raw_ostream.h"
#include "llvm/TargetParser/Host.h"

#include <cstring>
#include <span>
#include <unistd.h>

// clang's name. NOLINTNEXTLINE(readability-identifier-naming)
int clang_main(int Argc, char **Argv, const llvm::ToolContext &Context);

namespace vorion {

namespace {

constexpr std::string_view Tool = "vorion-compiler";

using Words = std::vector<std::string>;

/// While it lives, standard output goes to \p File.
class OutputTo {
public:
  explicit OutputTo(const MemoryFile &File);
  OutputTo(const OutputTo &) = delete;
  OutputTo &operator=(const OutputTo &) = delete;
  ~OutputTo();

private:
  int Before;
};

OutputTo::OutputTo(const MemoryFile &File) : Before(dup(STDOUT_FILENO)) {
  dup2(File.descriptor(), STDOUT_FILENO);
}

OutputTo::~OutputTo() {
  dup2(Before, STDOUT_FILENO);
  close(Before);
}

constexpr const char *NotCompiled =
    "cannot be compiled for the machine, expected a kernel that can";
constexpr const char *NotLinked =
    "cannot be linked, expected a kernel that can";

/// Why one of \p Files cannot be used; empty if all can.
std::string problemOf(std::initializer_list<const MemoryFile *> Files) {
  for (const MemoryFile *File : Files)
    if (const int Problem = File->problem())
      return std::string(strerror(Problem)) +
             ", expected memory for what is compiled";
  return {};
}

/// The call of the compiler proper that vorion-clang makes for \p Line. Empty,
/// and messages on standard error, if there is none.
Words compilerCall(const Words &Line) {
  using namespace clang;
  auto Options = llvm::makeIntrusiveRefCnt<DiagnosticOptions>();
  DiagnosticsEngine Messages(
      llvm::makeIntrusiveRefCnt<DiagnosticIDs>(), Options,
      new TextDiagnosticPrinter(llvm::errs(), Options.get()));
  driver::Driver Driver(Line[0], llvm::sys::getDefaultTargetTriple(), Messages);
  Driver.setTargetAndMode(
      driver::ToolChain::getTargetAndModeFromProgramName(Line[0]));
  std::vector<const char *> Pointers;
  Pointers.reserve(Line.size());
  for (const std::string &Word : Line)
    Pointers.push_back(Word.c_str());
  const std::unique_ptr<driver::Compilation> Steps(
      Driver.BuildCompilation(Pointers));
  if (!Steps || Steps->containsError() || Steps->getJobs().size() != 1)
    return {};
  Words Call = {Line[0]};
  for (const char *Word : Steps->getJobs().begin()->getArguments())
    Call.emplace_back(Word);
  return Call;
}

/// Whether \p Call succeeded.
bool runCompiler(Words Call) {
  std::vector<char *> Pointers;
  Pointers.reserve(Call.size());
  for (std::string &Word : Call)
    Pointers.push_back(Word.data());
  return clang_main(static_cast<int>(Pointers.size()), Pointers.data(),
                    {Pointers[0], nullptr, false}) == 0;
}

/// An object as a file for lld.
struct ObjectFile {
  std::string Name; ///< in messages
  MemoryFile File;
};

/// Writes what lld says to standard error, with the names of \p Objects instead
/// of those of their files.
class LinkerMessages : public llvm::raw_ostream {
public:
  explicit LinkerMessages(std::span<const ObjectFile> Objects)
      : raw_ostream(/*unbuffered=*/true), Objects(Objects) {}

private:
  void write_impl(const char *Text, size_t Size) override {
    std::string Message(Text, Size);
    for (const ObjectFile &Object : Objects)
      rename(Message, Object.File.path(), Object.Name);
    llvm::errs() << Message;
  }
  uint64_t current_pos() const override { return 0; }

  static void rename(std::string &Message, const std::string &Path,
                     const std::string &Name) {
    for (size_t At = 0; (At = Message.find(Path, At)) != std::string::npos;) {
      const size_t End = At + Path.size();
      if (End < Message.size() && llvm::isDigit(Message[End])) {
        At = End; // the file of another one
        continue;
      }
      Message.replace(At, Path.size(), Name);
      At += Name.size();
    }
  }

  std::span<const ObjectFile> Objects;
};

/// The program of \p Objects, which \p Out gets first.
Expected<std::string> linkTo(const MemoryFile &Out,
                             std::span<const ObjectFile> Objects) {
  std::vector<std::string> Words;
  for (const ObjectFile &Object : Objects) {
    const std::string Bytes = Object.File.contents();
    if (const auto Good =
            link::checkInput(std::as_bytes(std::span(Bytes)), Object.Name);
        !Good)
      return Good.error();
    Words.push_back(Object.File.path());
  }
  Words.insert(Words.end(), {"-o", "-"});
  const auto Arguments = link::programArguments(Words);
  if (!Arguments)
    return Arguments.error();
  {
    const OutputTo Linked(Out);
    LinkerMessages Messages(Objects);
    if (!link::callLld(*Arguments, Messages))
      return Error{"", "the link failed, expected no errors of ld.lld-19 (see "
                       "its messages above)"};
  }
  std::string Program = Out.contents();
  const auto Completed = link::completeProgram(
      std::as_writable_bytes(std::span(Program)), Tool, "");
  if (!Completed)
    return Completed.error();
  return Program;
}

/// The image of \p Objects.
MachineAnswer linkFiles(std::span<const ObjectFile> Objects) {
  MachineAnswer Made;
  const MemoryFile Out;
  Made.Problem = problemOf({&Out});
  for (const ObjectFile &Object : Objects)
    if (Made.Problem.empty())
      Made.Problem = problemOf({&Object.File});
  if (!Made.Problem.empty())
    return Made;
  Expected<std::string> Program = linkTo(Out, Objects);
  if (Program) {
    Made.Image = std::move(*Program);
  } else {
    reportError(Tool, Program.error());
    Made.Problem = NotLinked;
  }
  return Made;
}

/// What vorion-clang is called with to make an object of \p Bitcode on standard
/// output.
Words commandLine(const MachineRequest &Request, const std::string &Bin,
                  const MemoryFile &Bitcode) {
  Words Line = {Bin + "/vorion-clang",
                "-x",
                "ir",
                Request.Optimize ? "-O2" : "-O0",
                "-ffp-contract=off",
                "-c",
                Bitcode.path(),
                "-o",
                "-"};
  Line.insert(Line.end(), Request.Options.begin(), Request.Options.end());
  return Line;
}

} // namespace

MachineAnswer makeImage(const MachineRequest &Request, const std::string &Bin) {
  MachineAnswer Made;
  const MemoryFile Bitcode(Request.Bitcode);
  const ObjectFile Object{Request.Name, MemoryFile()};
  Made.Problem = problemOf({&Bitcode, &Object.File});
  if (!Made.Problem.empty())
    return Made;
  Words Call = compilerCall(commandLine(Request, Bin, Bitcode));
  {
    const OutputTo Compiled(Object.File);
    if (Call.empty() || !runCompiler(std::move(Call))) {
      Made.Problem = NotCompiled;
      return Made;
    }
  }
  if (Request.WantsImage)
    Made = linkFiles({&Object, 1});
  Made.Object = Object.File.contents();
  return Made;
}

MachineAnswer linkObjects(const std::vector<NamedObject> &Objects) {
  std::vector<ObjectFile> Files;
  Files.reserve(Objects.size());
  for (const NamedObject &Object : Objects)
    Files.push_back({Object.Name, MemoryFile(Object.Bytes)});
  return linkFiles(Files);
}

bool areOptions(const std::vector<std::string> &Options,
                const std::string &Bin) {
  Words Line = {Bin + "/vorion-clang", "-x", "c", "-fsyntax-only", "/dev/null"};
  Line.insert(Line.end(), Options.begin(), Options.end());
  Words Call = compilerCall(Line);
  return !Call.empty() && runCompiler(std::move(Call));
}

} // namespace vorion
