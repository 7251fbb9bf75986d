// vorion-explorer: source, LLVM IR, machine code and cycles of kernels in one
// page, which follows the files while the tool runs. `vorion-clang --explorer`
// starts it.

#include "ExplorerPage.h"
#include "mem/SourceLines.h"
#include "page/Page.h"
#include "vorion/isasim/Image.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/RemovedAtEnd.h"
#include "vorion/support/TemporaryFolder.h"
#include "vorion/support/Tool.h"
#include "vorion/support/Version.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <spawn.h>
#include <string>
#include <string_view>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace vorion::explorer {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

constexpr std::string_view Tool = "vorion-explorer";

struct Options {
  std::string Source, Output, Profile, Launch;
  Words Sets;     ///< of the machine that runs the launch
  Words Compiler; ///< options
  bool Once = false;
};

std::string textOf(const std::vector<std::byte> &Bytes) {
  return {reinterpret_cast<const char *>(Bytes.data()), Bytes.size()};
}

Words linesOf(std::string_view Text) {
  Words Lines;
  while (!Text.empty()) {
    const std::size_t End = std::min(Text.find('\n'), Text.size());
    Lines.emplace_back(Text.substr(0, End));
    Text.remove_prefix(std::min(End + 1, Text.size()));
  }
  return Lines;
}

/// What a program of this installation printed, and how it ended.
struct Ended {
  int Code = 0;
  std::string Out, Log;
};

/// The programs beside this one, run with files in a folder of their own.
class Tools {
public:
  explicit Tools(std::string Work) : Work(std::move(Work)) {
    std::error_code Ignored;
    Bin = fs::read_symlink("/proc/self/exe", Ignored).parent_path();
  }

  Expected<Ended> run(const char *Name, Words Arguments) const {
    const std::string Out = Work + "/out", Log = Work + "/log";
    Arguments.insert(Arguments.begin(), (Bin / Name).string());
    std::vector<char *> Pointers;
    for (std::string &Word : Arguments)
      Pointers.push_back(Word.data());
    Pointers.push_back(nullptr);
    posix_spawn_file_actions_t Actions;
    posix_spawn_file_actions_init(&Actions);
    for (const auto &[Descriptor, File] :
         {std::pair(STDOUT_FILENO, Out), {STDERR_FILENO, Log}})
      posix_spawn_file_actions_addopen(&Actions, Descriptor, File.c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC, 0600);
    pid_t Child = 0;
    const int Problem = posix_spawn(&Child, Pointers.front(), &Actions, nullptr,
                                    Pointers.data(), environ);
    posix_spawn_file_actions_destroy(&Actions);
    if (Problem != 0)
      return Error{Arguments.front(),
                   fmt::format("cannot start: {}, expected the program that is "
                               "installed with this one",
                               std::strerror(Problem))};
    int Status = 0;
    while (waitpid(Child, &Status, 0) < 0 && errno == EINTR)
      ;
    const auto Printed = readFile(Out);
    const auto Said = readFile(Log);
    if (!Printed || !Said)
      return Printed ? Said.error() : Printed.error();
    return Ended{WIFEXITED(Status) ? WEXITSTATUS(Status) : 70, textOf(*Printed),
                 textOf(*Said)};
  }
  std::string file(std::string_view Name) const {
    return fmt::format("{}/{}", Work, Name);
  }

private:
  std::string Work;
  fs::path Bin;
};

/// Whether the debug information's \p File is \p Source.
bool isSource(const std::string &File, const std::string &Source) {
  return fs::path(File).lexically_normal() ==
         fs::path(Source).lexically_normal();
}

/// The number behind \p Before in \p Text, if that is there.
std::optional<unsigned> numberBehind(std::string_view Text,
                                     std::string_view Before) {
  const std::size_t At = Text.find(Before);
  unsigned Number = 0;
  if (At == std::string_view::npos)
    return std::nullopt;
  const char *First = Text.data() + At + Before.size();
  return std::from_chars(First, Text.data() + Text.size(), Number).ec ==
                 std::errc()
             ? std::optional(Number)
             : std::nullopt;
}

/// The functions of a module that are defined, with the source's line of each
/// instruction.
Json irOf(const Words &Module, const std::string &Source) {
  // Metadata, by number: what a location, a scope and a file are.
  std::map<unsigned, std::string> Nodes;
  for (const std::string &Line : Module)
    if (Line.starts_with('!'))
      if (const auto Number = numberBehind(Line, "!"))
        Nodes.emplace(*Number, Line);
  const auto Text = [&](std::optional<unsigned> Number) -> std::string_view {
    const auto Found = Number ? Nodes.find(*Number) : Nodes.end();
    return Found == Nodes.end() ? std::string_view() : Found->second;
  };
  const auto IsOfSource = [&](std::string_view Scope) {
    const auto File = Text(numberBehind(Scope, "file: !"));
    const std::size_t Name = File.find("filename: \"");
    if (Name == std::string_view::npos)
      return false;
    const std::string_view From = File.substr(Name + 11);
    return isSource(std::string(From.substr(0, From.find('"'))), Source);
  };
  const auto LineOf = [&](std::string_view Instruction) -> unsigned {
    // What was inlined from elsewhere counts at its call.
    auto At = Text(numberBehind(Instruction, "!dbg !"));
    for (unsigned Depth = 0; Depth < 64 && !At.empty(); ++Depth) {
      const auto Line = numberBehind(At, "line: ");
      if (Line && IsOfSource(Text(numberBehind(At, "scope: !"))))
        return *Line;
      At = Text(numberBehind(At, "inlinedAt: !"));
    }
    return 0;
  };
  static const std::regex Attached(
      ",? !(dbg|tbaa|invariant.load|noundef|srcloc)"
      "( ![0-9]+)?");
  Json Lines = Json::array();
  bool IsInside = false;
  for (const std::string &Line : Module) {
    IsInside |= Line.starts_with("define ");
    if (!IsInside || Line.find("#dbg_") != std::string::npos ||
        Line.find("@llvm.lifetime.") != std::string::npos)
      continue;
    Lines.push_back({{"text", std::regex_replace(Line, Attached, "")},
                     {"line", Line.starts_with("define ") ? 0 : LineOf(Line)}});
    if (Line == "}") {
      IsInside = false;
      Lines.push_back({{"text", ""}, {"line", 0}});
    }
  }
  return Lines;
}

/// What a profile says of instructions: by address.
struct Costs {
  Json Summary; ///< machine, unit and total
  std::map<uint64_t, Json> ByAddress;
};

/// Of the program of \p Report whose instructions are those of \p Code.
std::optional<Costs> costsOf(const Json &Report,
                             const std::map<uint64_t, uint32_t> &Code) {
  const auto Programs = Report.find("programs");
  if (Programs == Report.end() || !Programs->is_array())
    return std::nullopt;
  const bool HasCycles = Report.contains("cycles");
  Costs Found;
  uint64_t Executed = 0;
  for (const Json &Program : *Programs) {
    Found.ByAddress.clear();
    Executed = 0;
    bool IsSame = true;
    for (const Json &I : Program.value("instructions", Json::array())) {
      const auto At = Code.find(I.value("pc", uint64_t{0}));
      IsSame &= At != Code.end() && At->second == I.value("code", uint64_t{0});
      const auto Times = I.value("executed", uint64_t{0});
      Executed += Times;
      Json Cost{{"executed", Times}, {"cost", Times}};
      if (HasCycles) {
        Cost["cost"] = I.value("cycles", uint64_t{0});
        Cost["reasons"] = I.value("by_reason", Json::object());
      }
      Found.ByAddress.emplace(At == Code.end() ? 0 : At->first,
                              std::move(Cost));
    }
    if (!IsSame)
      continue;
    Found.Summary = {
        {"unit", HasCycles ? "cycles" : "warp instructions"},
        {"total", HasCycles ? Report["cycles"].get<uint64_t>() : Executed},
        {"machine", HasCycles
                        ? fmt::format("{}, {} MHz, cycles of all cores",
                                      Report.value("machine", ""),
                                      Report.value("clock_mhz", uint64_t{0}))
                        : ""}};
    return Found;
  }
  return std::nullopt;
}

/// An instruction or a label of llvm-objdump's listing.
struct Listed {
  std::string Label, Text;
  uint64_t Address = 0;
  uint32_t Code = 0;
};

std::vector<Listed> listingOf(const std::string &Text) {
  static const std::regex Label("^([0-9a-f]+) <(.*)>:$");
  static const std::regex Instruction(
      "^ *([0-9a-f]+): +([0-9a-f]{8}) +\\t?(.*)$");
  std::vector<Listed> All;
  for (const std::string &Line : linesOf(Text)) {
    std::smatch Parts;
    if (std::regex_match(Line, Parts, Label)) {
      // The assembler's own are inside of a function.
      if (Listed L; !Parts[2].str().starts_with(".L")) {
        L.Label = Parts[2];
        All.push_back(std::move(L));
      }
    } else if (std::regex_match(Line, Parts, Instruction)) {
      Listed L;
      L.Address = std::stoull(Parts[1], nullptr, 16);
      L.Code = static_cast<uint32_t>(std::stoul(Parts[2], nullptr, 16));
      L.Text = Parts[3];
      if (const std::size_t Tab = L.Text.find('\t'); Tab != std::string::npos)
        L.Text = fmt::format("{:<9} {}", L.Text.substr(0, Tab),
                             L.Text.substr(Tab + 1));
      All.push_back(std::move(L));
    }
  }
  return All;
}

class Explorer {
public:
  Explorer(Options O, Tools T) : O(std::move(O)), T(std::move(T)) {}

  /// Compiles, and writes the page. What is wrong with the kernel is in it.
  Expected<Success> update() {
    ++Serial;
    const auto Source = readFile(O.Source);
    if (!Source)
      return Source.error();
    Data["source"] = linesOf(textOf(*Source));
    Data["log"] = "";
    const auto Compiled = compile();
    if (!Compiled)
      return Compiled.error();
    Data["serial"] = Serial;
    if (!O.Once) {
      const std::string Script =
          fmt::format("explorerData({});\n", jsonText(Data));
      if (auto Ok = writeFileAtomically(O.Output + ".js", Script); !Ok)
        return Ok;
    }
    return writeFileAtomically(
        O.Output, splat::filledPage(splat::explorerTemplate(), Data, ""));
  }

  /// What changes with the files that the page is of.
  std::vector<fs::file_time_type> times() const {
    std::vector<fs::file_time_type> All;
    std::error_code Ignored;
    for (const std::string &File : {O.Source, O.Profile, O.Launch})
      if (!File.empty())
        All.push_back(fs::last_write_time(File, Ignored));
    const fs::path Beside = fs::path(O.Source).parent_path();
    for (const auto &Entry :
         fs::directory_iterator(Beside.empty() ? "." : Beside, Ignored))
      if (Entry.path().extension() == ".h" || Entry.path().extension() == ".cl")
        All.push_back(Entry.last_write_time(Ignored));
    return All;
  }

  bool failed() const { return Failed; }
  std::string log() const { return Data["log"].get<std::string>(); }

private:
  Expected<Success> compile() {
    const std::string Program = T.file("program.elf");
    Words Call{"-g"};
    Call.insert(Call.end(), O.Compiler.begin(), O.Compiler.end());
    Data["command"] =
        fmt::format("vorion-clang {} {}", fmt::join(Call, " "), O.Source);
    Call.insert(Call.end(), {O.Source, "-save-temps=obj", "-o", Program});
    const auto Built = T.run("vorion-clang", Call);
    if (!Built)
      return Built.error();
    say(Built->Log);
    Failed = Built->Code != 0;
    if (Failed)
      return Success{}; // the page keeps what was compiled last

    const auto Elf = readFile(Program);
    if (!Elf)
      return Elf.error();
    const auto Image = isasim::Image::parse(*Elf, O.Source);
    if (!Image)
      return Image.error();
    Json Ir = Json::array();
    for (const isasim::Kernel &K : (*Image)->kernels()) {
      const auto Module =
          T.run("vorion-opt", {"-O2", "-mtriple=riscv32", "-mcpu=vorion", "-S",
                               T.file(K.Name + ".bc"), "-o", "-"});
      if (!Module)
        return Module.error();
      for (Json &Line : irOf(linesOf(Module->Out), O.Source))
        Ir.push_back(std::move(Line));
    }
    Data["ir"] = std::move(Ir);
    const auto Listing = T.run("vorion-objdump", {"--disassemble", Program});
    if (!Listing)
      return Listing.error();
    return assemble(listingOf(Listing->Out), *Image);
  }

  /// The machine code with its lines and costs.
  Expected<Success> assemble(const std::vector<Listed> &Listing,
                             const std::shared_ptr<const isasim::Image> &Of) {
    std::map<uint64_t, uint32_t> Code;
    for (const Listed &L : Listing)
      if (L.Label.empty())
        Code.emplace(L.Address, L.Code);
    const auto Spent = costs(Code);
    if (!Spent)
      return Spent.error();
    const isasim::SourceLines Places(Of);
    Json All = Json::array();
    for (const Listed &L : Listing) {
      if (!L.Label.empty()) {
        All.push_back({{"label", L.Label}});
        continue;
      }
      Json I{{"address", fmt::format("{:x}", L.Address)}, {"text", L.Text}};
      unsigned Line = 0;
      for (const isasim::SourcePlace &P :
           Places.chain(static_cast<uint32_t>(L.Address)))
        if (!P.IsNear && isSource(P.File, O.Source)) {
          Line = P.Line;
          break;
        }
      I["line"] = Line;
      if (*Spent)
        if (const auto Cost = (*Spent)->ByAddress.find(L.Address);
            Cost != (*Spent)->ByAddress.end())
          I.update(Cost->second);
      All.push_back(std::move(I));
    }
    Data["assembly"] = std::move(All);
    Data["profile"] = *Spent ? (*Spent)->Summary : Json();
    return Success{};
  }

  /// Of the profile that was given, or of a run.
  Expected<std::optional<Costs>>
  costs(const std::map<uint64_t, uint32_t> &Code) {
    std::string File = O.Profile;
    if (!O.Launch.empty()) {
      File = T.file("profile.json");
      Words Call{T.file("program.elf"), "--args", O.Launch, "--time",
                 "--profile=" + File};
      for (const std::string &Set : O.Sets)
        Call.insert(Call.end(), {"--set", Set});
      const auto Ran = T.run("vorion-sim", std::move(Call));
      if (!Ran)
        return Ran.error();
      if (Ran->Code != 0) {
        say(Ran->Log);
        Failed = true;
        return std::optional<Costs>();
      }
    }
    if (File.empty())
      return std::optional<Costs>();
    const auto Report = readJson<Json>(
        File, "a profile that vorion-sim --profile=FILE.json has written",
        {.Keys = 100000});
    if (!Report)
      return Report.error();
    auto Found = costsOf(*Report, Code);
    if (!Found)
      say(fmt::format("{}: is of other instructions, expected a profile of "
                      "this program with these options\n",
                      File));
    return Found;
  }

  void say(const std::string &Text) {
    Data["log"] = Data["log"].get<std::string>() + Text;
  }

  const Options O;
  const Tools T;
  unsigned Serial = 0;
  bool Failed = false;
  Json Data{{"file", O.Source},
            {"follows", !O.Once},
            {"run", std::chrono::system_clock::now().time_since_epoch() /
                        std::chrono::milliseconds(1)},
            {"made", versionLine(Tool)},
            {"ir", Json::array()},
            {"assembly", Json::array()},
            {"profile", nullptr}};
};

Expected<int> run(Options O) {
  if (O.Output.empty())
    O.Output = fs::path(O.Source).stem().string() + ".html";
  const std::string Script = O.Once ? "" : O.Output + ".js";
  if (auto Ok = claimOutputs({{"-o", O.Output}, {"the page's data", Script}},
                             {{"the kernel", O.Source},
                              {"--profile", O.Profile},
                              {"--args", O.Launch}});
      !Ok)
    return Ok.error();
  const auto Work = TemporaryFolder::make("vorion-explorer");
  if (!Work)
    return Work.error();
  Explorer E(O, Tools(Work->path()));
  auto Seen = E.times();
  if (auto Ok = E.update(); !Ok)
    return Ok.error();
  printNote(E.log());
  if (O.Once)
    return static_cast<int>(E.failed() ? ExitCode::InputFile : ExitCode::Ok);
  const RemovedAtEnd Follows(Script);
  printOut("{}: follows {} until Ctrl-C\n", O.Output, O.Source);
  std::fflush(stdout);
  for (;;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    auto Now = E.times();
    if (Now == Seen)
      continue;
    Seen = std::move(Now);
    // An editor may be about to write a file that is not there now.
    if (auto Ok = E.update(); !Ok)
      printDiagnostic(Tool, "warning", Ok.error().Where, Ok.error().What);
    printNote(E.log());
  }
}

void declare(CLI::App &App, Options &O) {
  App.footer(std::string(ExitCodeHelp) +
             "\nall other options are vorion-clang's");
  App.set_version_flag("--version", std::string(versionLine(Tool)));
  takesFile(App.add_option("kernel", O.Source, "OpenCL C"), {".cl"})
      ->required();
  writesFile(App.add_option("-o,--output", O.Output,
                            "The page (default: the kernel's name with .html, "
                            "in the current folder)"),
             {".html"});
  App.add_flag("--once", O.Once, "Write the page once, and end");
  takesFile(App.add_option("--profile", O.Profile,
                           "Cycles or executions of a run of this program: "
                           "vorion-sim --profile=FILE.json"),
            {".json"});
  takesFile(App.add_option("--args", O.Launch,
                           "Run the kernel with the clock each time: kernel, "
                           "global, local and args as of vorion-sim --args"),
            {".json"})
      ->excludes("--profile");
  App.add_option("--set", O.Sets, "Configuration keys of the machine that runs")
      ->option_text("KEY=VALUE,...")
      ->allow_extra_args(false)
      ->needs("--args");
  struct Passed {
    const char *Option, *Value, *Help;
  };
  for (const auto &[Option, Value, Help] :
       {Passed{"-D", "NAME[=TEXT]", "Define a macro, as of vorion-clang"},
        {"-U", "NAME", "Undefine a macro"},
        {"-I", "FOLDER", "Where headers are"}})
    App.add_option_function<Words>(
           Option,
           [&O, Flag = std::string(Option)](const Words &All) {
             for (const std::string &Each : All)
               O.Compiler.push_back(Flag + Each);
           },
           Help)
        ->option_text(Value)
        ->allow_extra_args(false);
  App.allow_extras();
}

} // namespace
} // namespace vorion::explorer

int main(int Count, char **Values) {
  using namespace vorion;
  return runTool(explorer::Tool, [&] {
    CLI::App App("Shows source, LLVM IR, machine code and cycles of kernels in "
                 "one page, which follows the file.",
                 std::string(explorer::Tool));
    explorer::Options O;
    explorer::declare(App, O);
    if (const auto Ended = parseCommandLine(App, {Values + 1, Values + Count}))
      return *Ended;
    for (const std::string &Word : App.remaining())
      O.Compiler.push_back(Word);
    const auto Done = explorer::run(std::move(O));
    return Done ? *Done : reportError(explorer::Tool, Done.error());
  });
}
