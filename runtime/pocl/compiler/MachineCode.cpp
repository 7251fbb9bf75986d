#include "MachineCode.h"

#include "Lld.h"
#include "ObjectCheck.h"
#include "Program.h"
#include "vorion/support/Diagnostics.h"

#include "llvm/Support/VirtualFileSystem.h"

#include "clang/Basic/DiagnosticOptions.h"
#include "clang/Driver/Compilation.h"
#include "clang/Driver/Driver.h"
#include "clang/Driver/ToolChain.h"
#include "clang/Frontend/TextDiagnosticPrinter.h"
#include "llvm/Support/LLVMDriver.h"
#include "llvm/Support/raw_ostream.h"
#include "llvm/TargetParser/Host.h"

#include <array>
#include <cerrno>
#include <span>
#include <sys/mman.h>
#include <unistd.h>

// clang's name. NOLINTNEXTLINE(readability-identifier-naming)
int clang_main(int Argc, char **Argv, const llvm::ToolContext &Context);

namespace vorion {

namespace {

using Words = std::vector<std::string>;

/// A file in memory, for code that reads and writes files.
class MemoryFile {
public:
  /// Empty, or with \p Contents. Whether there is memory is known by isGood().
  explicit MemoryFile(std::string_view Contents = {});
  MemoryFile(const MemoryFile &) = delete;
  MemoryFile &operator=(const MemoryFile &) = delete;
  ~MemoryFile();

  bool isGood() const { return Good; }
  int descriptor() const { return Descriptor; }
  /// Its name in this process.
  std::string path() const;
  std::string contents() const;

private:
  int Descriptor;
  bool Good;
};

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

MemoryFile::MemoryFile(std::string_view Contents)
    : Descriptor(memfd_create("vorion", MFD_CLOEXEC)), Good(Descriptor >= 0) {
  while (Good && !Contents.empty()) {
    const ssize_t Written = write(Descriptor, Contents.data(), Contents.size());
    if (Written > 0)
      Contents.remove_prefix(static_cast<size_t>(Written));
    else
      Good = Written < 0 && errno == EINTR;
  }
}

MemoryFile::~MemoryFile() { close(Descriptor); }

std::string MemoryFile::path() const {
  return "/proc/self/fd/" + std::to_string(Descriptor);
}

std::string MemoryFile::contents() const {
  std::string All;
  std::array<char, 65536> Part{};
  for (ssize_t Got = 0; (Got = pread(Descriptor, Part.data(), Part.size(),
                                     static_cast<off_t>(All.size()))) > 0;)
    All.append(Part.data(), static_cast<size_t>(Got));
  return All;
}

OutputTo::OutputTo(const MemoryFile &File) : Before(dup(STDOUT_FILENO)) {
  dup2(File.descriptor(), STDOUT_FILENO);
}

OutputTo::~OutputTo() {
  dup2(Before, STDOUT_FILENO);
  close(Before);
}

constexpr const char *NoMemory =
    "memory ran out while it was compiled, expected more";
constexpr const char *NotCompiled =
    "cannot be compiled for the machine, expected a kernel that can";
constexpr const char *NotLinked =
    "cannot be linked, expected a kernel that can";

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

/// The program of \p Object, which \p Out gets first.
Expected<std::string> linkObject(const MemoryFile &Object,
                                 const MemoryFile &Out) {
  const std::string Bytes = Object.contents();
  if (const auto Good =
          link::checkInput(std::as_bytes(std::span(Bytes)), Object.path());
      !Good)
    return Good.error();
  const auto Arguments = link::programArguments({Object.path(), "-o", "-"});
  if (!Arguments)
    return Arguments.error();
  {
    const OutputTo Linked(Out);
    if (!link::callLld(*Arguments))
      return Error{"", "the link failed, expected no errors of ld.lld-19 (see "
                       "its messages above)"};
  }
  std::string Program = Out.contents();
  const auto Completed = link::completeProgram(
      std::as_writable_bytes(std::span(Program)), "the program");
  if (!Completed)
    return Completed.error();
  return Program;
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
  const MemoryFile Bitcode(Request.Bitcode), Object, Out;
  if (!Bitcode.isGood() || !Object.isGood() || !Out.isGood()) {
    Made.Problem = NoMemory;
    return Made;
  }
  Words Call = compilerCall(commandLine(Request, Bin, Bitcode));
  {
    const OutputTo Compiled(Object);
    if (Call.empty() || !runCompiler(std::move(Call))) {
      Made.Problem = NotCompiled;
      return Made;
    }
  }
  Expected<std::string> Program = linkObject(Object, Out);
  if (Program) {
    Made.Image = std::move(*Program);
    Made.Object = Object.contents();
  } else {
    reportError("vorion-compiler", Program.error());
    Made.Problem = NotLinked;
  }
  return Made;
}

} // namespace vorion
