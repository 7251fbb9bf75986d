//===- PrecompiledHeaders.cc - OpenCL's declarations, parsed once ---------===//

#include "PrecompiledHeaders.h"

#include "pocl_cache.h"
#include "pocl_checked_file.h"

#include <clang/Basic/Version.h>
#include <clang/Frontend/FrontendActions.h>
#include <clang/Lex/PreprocessorOptions.h>
#include <clang/Serialization/ASTWriter.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/ADT/StringSet.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/Support/VirtualFileSystem.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/Support/xxhash.h>

#include <cstdlib>
#include <map>
#include <mutex>

using namespace clang;
using namespace llvm;

namespace pocl {

namespace {

/// Where a compilation finds the state of the headers; no file of the host.
constexpr const char *StatePath = "/precompiled-opencl-headers";

/// Writes what clang knows after its input into memory.
class PrecompileToMemory : public GeneratePCHAction {
public:
  std::shared_ptr<PCHBuffer> State = std::make_shared<PCHBuffer>();

protected:
  std::unique_ptr<ASTConsumer> CreateASTConsumer(CompilerInstance &Instance,
                                                 StringRef) override {
    return std::make_unique<PCHGenerator>(
        Instance.getPreprocessor(), Instance.getModuleCache(),
        /*OutputFile=*/"", /*isysroot=*/"", State,
        ArrayRef<std::shared_ptr<ModuleFileExtension>>(),
        /*AllowASTWithErrors=*/false, /*IncludeTimestamps=*/false);
  }
};

/// The name of NAME, NAME=VALUE or NAME(PARAMETERS)=VALUE.
StringRef macroName(StringRef Macro) {
  return Macro.take_until([](char C) { return C == '=' || C == '('; });
}

/// Names that the options define.
StringSet<> macrosOf(StringRef Options) {
  StringSet<> Names;
  SmallVector<StringRef, 16> Words;
  SplitString(Options, Words, " \t\n\v\f\r");
  for (size_t I = 0; I < Words.size(); ++I) {
    StringRef Word = Words[I].ltrim('"');
    if (!Word.consume_front("-D"))
      continue;
    if (Word.empty() && I + 1 < Words.size())
      Word = Words[++I].ltrim('"');
    Names.insert(macroName(Word));
  }
  return Names;
}

/// How the headers are parsed for a program.
std::shared_ptr<CompilerInvocation>
withoutTheProgram(const CompilerInvocation &Program, StringRef UserOptions) {
  auto Headers = std::make_shared<CompilerInvocation>(Program);
  Headers->getCodeGenOpts() = CodeGenOptions();
  Headers->getFrontendOpts().Inputs.clear();
  Headers->getHeaderSearchOpts().UserEntries.clear();

  PreprocessorOptions &Preprocessor = Headers->getPreprocessorOpts();
  Preprocessor.Includes.clear();
  // A macro that the system defines, too, stays: a program has to see the
  // macros with which its headers were parsed.
  StringMap<unsigned> Times;
  for (const auto &Macro : Preprocessor.Macros)
    ++Times[macroName(Macro.first)];
  const StringSet<> Users = macrosOf(UserOptions);
  llvm::erase_if(Preprocessor.Macros, [&](const auto &Macro) {
    const StringRef Name = macroName(Macro.first);
    return Users.contains(Name) && Times[Name] == 1;
  });
  return Headers;
}

std::string hashOf(StringRef Text) {
  const XXH128_hash_t Hash = xxh3_128bits(arrayRefFromStringRef(Text));
  return utohexstr(Hash.high64, true, 16) + utohexstr(Hash.low64, true, 16);
}

/// Headers are hashed where they are mapped: they have a megabyte, and each
/// program asks for the key.
std::string keyOf(const CompilerInvocation &Parse,
                  const std::vector<std::string> &Headers) {
  std::string All = POCL_CHECKSUM + getClangFullVersion();
  for (const std::string &Option : Parse.getCC1CommandLine())
    All += Option + '\0';
  for (const std::string &Header : Headers) {
    All += Header + '\0';
    if (const auto Content = MemoryBuffer::getFile(Header))
      All += hashOf((*Content)->getBuffer());
  }
  return hashOf(All);
}

HeadersState parse(std::shared_ptr<CompilerInvocation> Parse,
                   const std::vector<std::string> &Headers) {
  std::string Text;
  for (const std::string &Header : Headers)
    Text += "#include \"" + Header + "\"\n";
  const MemoryBufferRef Input(Text, "OpenCL's headers");
  Parse->getFrontendOpts().Inputs.emplace_back(Input,
                                               InputKind(Language::OpenCL));

  CompilerInstance Instance;
  Instance.setInvocation(std::move(Parse));
  Instance.createDiagnostics(new IgnoringDiagConsumer());
  Instance.setVerboseOutputStream(nulls());
  PrecompileToMemory Precompile;
  if (!Instance.ExecuteAction(Precompile) || !Precompile.State->IsComplete)
    return {};
  const auto &Data = Precompile.State->Data;
  return {{Precompile.State, Data.data()}, Data.size()};
}

/// What another process kept, if one did.
HeadersState read(const char *Path) {
  char *Bytes = nullptr;
  uint64_t Size = 0;
  if (pocl_read_checked_file(Path, &Bytes, &Size) != POCL_CHECKED_FILE_OK)
    return {};
  return {{Bytes, std::free}, Size};
}

HeadersState readOrParse(const std::string &Key,
                         std::shared_ptr<CompilerInvocation> Parse,
                         const std::vector<std::string> &Headers) {
  const bool HadProblem = pocl_file_problem() != nullptr;
  char Path[POCL_MAX_PATHNAME_LENGTH];
  const bool HasPlace =
      pocl_cache_headers_path(Path, sizeof(Path), Key.c_str()) == 0;
  HeadersState State = HasPlace ? read(Path) : HeadersState();
  if (!State.Bytes) {
    State = parse(std::move(Parse), Headers);
    if (State.Bytes && HasPlace)
      pocl_write_checked_file(Path, State.Bytes.get(), State.Size);
  }
  // That a state cannot be kept is no problem of the program.
  if (!HadProblem)
    pocl_forget_file_problem();
  return State;
}

/// The state that this process has of the headers.
HeadersState stateOf(const std::string &Key,
                     std::shared_ptr<CompilerInvocation> Parse,
                     const std::vector<std::string> &Headers) {
  static std::mutex Lock;
  static std::map<std::string, HeadersState> States;
  const std::lock_guard<std::mutex> Guard(Lock);
  if (const auto Found = States.find(Key); Found != States.end())
    return Found->second;
  // Each takes 3 MiB, and few programs use more than two sets of options.
  if (States.size() == 8)
    States.clear();
  return States[Key] = readOrParse(Key, std::move(Parse), Headers);
}

} // namespace

PrecompiledHeaders::PrecompiledHeaders(const CompilerInvocation &Program,
                                       std::vector<std::string> Headers,
                                       StringRef UserOptions)
    : Headers(std::move(Headers)) {
  std::shared_ptr<CompilerInvocation> Parse =
      withoutTheProgram(Program, UserOptions);
  Key = keyOf(*Parse, this->Headers);
  State = stateOf(Key, std::move(Parse), this->Headers);
}

void PrecompiledHeaders::addTo(CompilerInstance &Instance) const {
  PreprocessorOptions &Options = Instance.getPreprocessorOpts();
  if (!State.Bytes) {
    Options.Includes.insert(Options.Includes.end(), Headers.begin(),
                            Headers.end());
    return;
  }
  auto Memory = makeIntrusiveRefCnt<vfs::InMemoryFileSystem>();
  Memory->addFile(StatePath, /*ModificationTime=*/0,
                  MemoryBuffer::getMemBuffer(
                      StringRef(State.Bytes.get(), State.Size), StatePath,
                      /*RequiresNullTerminator=*/false));
  auto Files =
      makeIntrusiveRefCnt<vfs::OverlayFileSystem>(vfs::getRealFileSystem());
  Files->pushOverlay(Memory);
  Instance.createFileManager(Files);
  Options.ImplicitPCHInclude = StatePath;
  // The key has told already whether the state is of these headers and options.
  Options.DisablePCHOrModuleValidation = DisableValidationForModuleKind::PCH;
}

} // namespace pocl
