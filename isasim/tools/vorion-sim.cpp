/// Runs a program, or one kernel of it, on the simulated machine.

#include "tools/Arguments.h"
#include "tools/HelpFormatter.h"
#include "tools/Launch.h"
#include "tools/RegionRun.h"
#include "tools/Signature.h"
#include "vorion/isasim/Energy.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Session.h"
#include "vorion/isasim/Variables.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Tool.h"
#include "vorion/support/Version.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <memory>

using namespace vorion;
using namespace vorion::isasim;

namespace {

constexpr std::string_view Tool = "vorion-sim";

struct Options {
  std::string Program, ConfigText, ArgsFile;
  SessionOptions Watch;
  std::string Kernel, Global, Local, SignatureFile;
  unsigned SignatureGranularity = 4;
  std::vector<std::string> Args, Set;
  std::optional<uint64_t> MaxInstructions;
  std::optional<unsigned> Threads, ClockMhz;
  bool PrintDefaultConfig = false, PrintSchema = false, ListKernels = false,
       Time = false, PrintTiming = false, PrintEnergy = false,
       PrintTechnology = false;
  bool Energy = false;
  std::string TechnologyFile;
  std::optional<double> Volts;
  bool OneHart = false;
};

Expected<std::string> readText(const std::string &Path) {
  Expected<std::vector<std::byte>> Bytes = readFile(Path);
  if (!Bytes)
    return Bytes.error();
  return std::string(reinterpret_cast<const char *>(Bytes->data()),
                     Bytes->size());
}

/// \p Given, or the environment's \p Variable, which counts without it.
std::string orVariable(const std::string &Given, const char *Variable) {
  const char *Text = std::getenv(Variable);
  return Given.empty() && Text ? Text : Given;
}

/// Naming a technology or a voltage asks, too.
bool wantsEnergy(const Options &O) {
  return O.Energy || !O.TechnologyFile.empty() || O.Volts;
}

/// Nothing if nobody wants to know.
Expected<std::shared_ptr<const EnergyModel>> makeEnergyModel(const Options &O,
                                                             const Config &C) {
  if (!wantsEnergy(O))
    return std::shared_ptr<const EnergyModel>();
  const Expected<Technology> From =
      O.TechnologyFile.empty() ? Expected<Technology>(defaultTechnology())
                               : readTechnology(O.TechnologyFile);
  if (!From)
    return From.error();
  Expected<EnergyModel> Made =
      EnergyModel::create(*From, C.Timing.ClockMhz, O.Volts);
  if (!Made)
    return Made.error();
  return std::make_shared<const EnergyModel>(std::move(*Made));
}

Expected<Success> changeValues(Config &C, const Options &O) {
  for (const std::string &Values : O.Set)
    if (const Expected<Success> Ok = setValues(C, Values); !Ok)
      return Ok;
  if (!O.Set.empty())
    return Success{};
  const Expected<Success> Ok = setValues(C, orVariable("", "VORION_SET"));
  if (!Ok)
    return Error{"", "VORION_SET: " + Ok.error().What, Ok.error().Code};
  return Success{};
}

/// The machine that the options, and below them the environment, say; \p
/// Default where they name none.
Expected<Config> makeConfig(const Options &O, const Config &Default) {
  Config C = Default;
  const std::string Text = orVariable(O.ConfigText, "VORION_CONFIG");
  if (!Text.empty()) {
    const Expected<MachineSource> Found = findMachine(Text);
    if (!Found)
      return Found.error();
    const Expected<Config> Parsed = parseConfig(Found->Json, Found->Where);
    if (!Parsed)
      return Parsed;
    C = *Parsed;
  }
  if (O.OneHart)
    C.Clusters = C.SocketsPerCluster = C.CoresPerSocket = C.WarpsPerCore =
        C.LanesPerWarp = 1;
  if (const Expected<Success> Ok = changeValues(C, O); !Ok)
    return Ok.error();
  C.Timing.Enabled |= O.Time || wantsEnergy(O) || O.Watch.needClock();
  if (O.ClockMhz)
    C.Timing.ClockMhz = *O.ClockMhz;
  if (O.MaxInstructions)
    C.MaxInstructions = *O.MaxInstructions;
  if (O.Threads)
    C.HostThreads = *O.Threads;
  return C;
}

Error wrongSizes(std::string_view Option, const std::string &Given) {
  return {"",
          fmt::format("{}: {}, expected X[,Y[,Z]], whole numbers above 0",
                      Option, Given),
          ExitCode::Usage};
}

Error missingGlobal() {
  return {"",
          "--global is missing, expected X[,Y[,Z]], how many work-items run "
          "the kernel",
          ExitCode::Usage};
}

/// The launch that the options ask for; WorkDim 0 for none.
Expected<KernelRequest> makeRequest(const Options &O) {
  KernelRequest R;
  if (!O.ArgsFile.empty()) {
    const Expected<std::string> Text = readText(O.ArgsFile);
    if (!Text)
      return Text.error();
    return parseRequest(*Text, O.ArgsFile);
  }
  R.Kernel = O.Kernel;
  R.Args = O.Args;
  if (!O.Global.empty()) {
    R.WorkDim = parseSizes(O.Global, R.Global);
    if (R.WorkDim == 0)
      return wrongSizes("--global", O.Global);
  } else if (!O.Kernel.empty() || !O.Args.empty() || !O.Local.empty()) {
    return missingGlobal();
  }
  if (!O.Local.empty() && parseSizes(O.Local, R.Local) == 0)
    return wrongSizes("--local", O.Local);
  return R;
}

/// What the run reads and writes, which nothing else may be.
Expected<Success> claimFiles(const Options &O, const KernelRequest &Request) {
  std::vector<NamedFile> Outputs = O.Watch.outputs();
  Outputs.push_back({"--signature", O.SignatureFile});
  std::vector<NamedFile> Inputs{{"the program", O.Program},
                                {"--config", O.ConfigText},
                                {"--technology", O.TechnologyFile},
                                {"--args", O.ArgsFile}};
  for (const std::string &Text : Request.Args)
    if (const Expected<KernelInput> In = parseInput(Text)) {
      Outputs.push_back({"argument " + Text, In->WriteTo});
      // What inout: changes in its place is meant.
      if (In->ReadFrom != In->WriteTo)
        Inputs.push_back({"argument " + Text, In->ReadFrom});
    }
  return claimOutputs(Outputs, Inputs);
}

void printKernels(const Image &Program) {
  for (const Kernel &K : Program.kernels()) {
    printOut("{}(", K.Name);
    constexpr const char *Kinds[] = {"value", "global", "local"};
    for (size_t N = 0; N != K.Args.size(); ++N)
      printOut("{}{} {}[{}]", N ? ", " : "", Kinds[K.Args[N].Kind],
               K.Args[N].Name, K.Args[N].Size);
    printOut(")\n");
  }
}

/// A program's exit code N is the tool's, unless the tool would say something
/// else by it, or the system has no such code: then it is GuestFailed.
bool canPassOn(uint32_t N) {
  constexpr uint32_t Largest = 255;
  for (const ExitCode Own :
       {ExitCode::Ok, ExitCode::Usage, ExitCode::InputFile, ExitCode::Trap,
        ExitCode::LimitReached, ExitCode::Internal})
    if (N == static_cast<uint32_t>(Own))
      return false;
  return N <= Largest;
}

int exitCode(const RunResult &R) {
  switch (R.End) {
  case Outcome::Done:
    return static_cast<int>(ExitCode::Ok);
  case Outcome::GuestFailed:
    return canPassOn(R.ExitCode) ? static_cast<int>(R.ExitCode)
                                 : static_cast<int>(ExitCode::GuestFailed);
  case Outcome::Trap:
    return static_cast<int>(ExitCode::Trap);
  case Outcome::Hang:
  case Outcome::LimitReached:
    break;
  }
  return static_cast<int>(ExitCode::LimitReached);
}

/// Whether --check bounds would say more of how \p R ended, a run of \p O: a
/// kernel went where no memory is.
bool leftItsBuffers(const RunResult &R, const Options &O) {
  const TrapCause Cause = R.Fault.Cause;
  return R.End == Outcome::Trap && O.Watch.Check.empty() &&
         (!O.Global.empty() || !O.ArgsFile.empty()) &&
         (Cause == TrapCause::LoadFault || Cause == TrapCause::StoreFault);
}

/// Reports how the run of \p O ended and gives the exit code.
int reportOutcome(const RunResult &R, const Options &O) {
  std::fflush(stdout);
  std::string Report = R.Report;
  while (Report.ends_with('\n'))
    Report.pop_back();
  if (leftItsBuffers(R, O))
    Report += "\n  --check bounds says which buffer a kernel leaves, and where";
  if (R.End == Outcome::GuestFailed)
    printDiagnostic(
        Tool, "error", O.Program,
        fmt::format("the program failed with exit code {}{}", R.ExitCode,
                    canPassOn(R.ExitCode)
                        ? ""
                        : ", for which vorion-sim ends with 1 (see --help)"));
  else if (R.End != Outcome::Done)
    printDiagnostic(Tool, "error", O.Program,
                    fmt::format("{}: {}", describe(R.End), Report));
  return exitCode(R);
}

/// \p Code, unless it is 0 and what watched the runs has something to say.
int lastWord(int Code, const Session &Watch) {
  if (Code != 0)
    return Code;
  if (const Expected<Success> Came = Watch.finished(); !Came)
    return reportError(Tool, Came.error());
  return static_cast<int>(Watch.findings() ? ExitCode::GuestFailed
                                           : ExitCode::Ok);
}

/// What the run took in joules.
Expected<Success> printEnergy(const TimeReport &Time, const EnergyModel &By) {
  EnergyWork Work{Time.Cycles, Time.ClockMhz, {}};
  for (const Activity &A : Time.Activities)
    Work.Events.push_back({A.Unit, A.Event, A.Count});
  const Expected<Energy> Spent = By.energyOf(Work);
  if (!Spent)
    return Spent.error();
  printOut("{}", toText(*Spent, By.technology()));
  return Success{};
}

/// Reports and gives the exit code; \p Launch and \p Energy may be nullptr.
int finish(const RunResult &R, const Options &O, const Machine &M,
           const KernelLaunch *Launch, const EnergyModel *Energy,
           Session &Watch) {
  int Code = reportOutcome(R, O);
  // A program that did not end leaves no results.
  if (Launch && Code == 0)
    if (const Expected<Success> Ok = Launch->finish(); !Ok)
      Code = reportError(Tool, Ok.error());
  if (R.Time)
    printOut("{}", toText(*R.Time));
  if (R.Time && Energy)
    if (const Expected<Success> Ok = printEnergy(*R.Time, *Energy); !Ok)
      Code = reportError(Tool, Ok.error());
  const bool Ended = R.End == Outcome::Done || R.End == Outcome::GuestFailed;
  if (Ended && !O.SignatureFile.empty())
    if (const Expected<Success> Ok =
            writeSignature(M, O.SignatureFile, O.SignatureGranularity);
        !Ok)
      Code = reportError(Tool, Ok.error());
  if (const Expected<Success> Ok = Watch.runEnded(R); !Ok)
    return reportError(Tool, Ok.error());
  return lastWord(Code, Watch);
}

Expected<std::unique_ptr<Session>>
makeSession(const Options &O,
            std::shared_ptr<const EnergyModel> Energy = nullptr) {
  return Session::create(
      O.Watch, std::string(Tool),
      [](std::string_view Text) { printOut("{}", Text); }, std::move(Energy));
}

/// The option, if there is one, that a saved region has no use for.
const char *notForRegions(const Options &O, const KernelRequest &Request) {
  if (Request.WorkDim != 0)
    return O.ArgsFile.empty() ? "--global" : "--args";
  if (O.OneHart)
    return "--one-hart";
  if (!O.SignatureFile.empty())
    return "--signature";
  if (O.ListKernels)
    return "--list-kernels";
  if (wantsEnergy(O))
    return "--energy";
  // A region does not say where buffers lie.
  return O.Watch.Check.empty() ? nullptr : "--check";
}

int runSaved(const Options &O, const KernelRequest &Request,
             std::span<const std::byte> File) {
  if (const char *Given = notForRegions(O, Request))
    return reportError(
        Tool,
        Error{O.Program,
              fmt::format("a saved region, expected it without {}", Given),
              ExitCode::Usage});
  const Expected<SavedRegion> Region = parseRegion(File, O.Program);
  if (!Region)
    return reportError(Tool, Region.error());
  Expected<Config> C = makeConfig(O, Region->Machine);
  if (!C)
    return reportError(Tool, C.error());
  C->Timing.Enabled = true;
  if (const auto Fits = checkMachine(*Region, *C, O.Program); !Fits)
    return reportError(Tool, Fits.error());
  const auto Watch = makeSession(O);
  if (!Watch)
    return reportError(Tool, Watch.error());
  const Expected<std::unique_ptr<Machine>> M = Machine::create(*C);
  if (!M)
    return reportError(Tool, M.error());
  (*Watch)->attach(**M);
  const auto Last = runRegion(*Region, **M, **Watch, O.Watch.Region.empty(),
                              O.Program, printText);
  if (!Last)
    return reportError(Tool, Last.error());
  return lastWord(reportOutcome(*Last, O), **Watch);
}

int run(const Options &O) {
  warnOfMisspeltVariables(Tool);
  const Expected<Config> C = makeConfig(O, defaultMachine());
  if (!C)
    return reportError(Tool, C.error());
  const auto Energy = makeEnergyModel(O, *C);
  if (!Energy)
    return reportError(Tool, Energy.error());
  const Expected<KernelRequest> Request = makeRequest(O);
  if (!Request)
    return reportError(Tool, Request.error());
  if (const Expected<Success> Claimed = claimFiles(O, *Request); !Claimed)
    return reportError(Tool, Claimed.error());
  const Expected<std::vector<std::byte>> Elf = readFile(O.Program);
  if (!Elf)
    return reportError(Tool, Elf.error());
  if (isRegion(*Elf))
    return runSaved(O, *Request, *Elf);
  const auto Program = Image::parse(*Elf, O.Program);
  if (!Program)
    return reportError(Tool, Program.error());
  if (O.ListKernels) {
    printKernels(**Program);
    return 0;
  }
  if (const Expected<Success> Fits = (*Program)->checkLanes(C->LanesPerWarp);
      !Fits)
    return reportError(Tool, Fits.error());
  // What an image of kernels has for a main does nothing.
  if (Request->WorkDim == 0 && !(*Program)->kernels().empty())
    return reportError(Tool, missingGlobal());
  const auto Watch = makeSession(O, *Energy);
  if (!Watch)
    return reportError(Tool, Watch.error());
  Expected<std::unique_ptr<Machine>> M = Machine::create(*C);
  if (!M)
    return reportError(Tool, M.error());
  (*M)->load(*Program);
  (*Watch)->attach(**M);
  if (Request->WorkDim == 0) {
    (*Watch)->runBegins("", 0);
    return finish((*M)->run(), O, **M, nullptr, Energy->get(), **Watch);
  }
  const Expected<KernelLaunch> Launch =
      KernelLaunch::prepare(**M, *Request, **Watch);
  if (!Launch)
    return reportError(Tool, Launch.error());
  (*Watch)->runBegins(Launch->kernel(), Launch->launchBlock());
  return finish((*M)->run(Launch->launchBlock()), O, **M, &*Launch,
                Energy->get(), **Watch);
}

/// An option of SessionOptions.def. One that may stand alone takes a value as
/// --option=VALUE only, so that it does not swallow the program's name.
void declareWatch(CLI::App &App, const SessionOption &S, std::string &To) {
  CLI::Option *Added = nullptr;
  if (S.Alone)
    Added = App.add_flag(fmt::format("{}{{{}}}", S.Option, S.Alone), To, S.Help)
                ->type_name(fmt::format("[={}]", S.Value));
  else
    Added = App.add_option(S.Option, To, S.Help)->type_name(S.Value);
  if (std::string_view(S.Value) == "FILE")
    writesFile(Added)->type_name(S.Alone ? "[=FILE]" : "FILE");
  else if (std::string_view(S.Value) == "PREFIX")
    writesFiles(Added);
  if (!S.Names.empty())
    takesSomeOf(Added, {S.Names.begin(), S.Names.end()});
  Added->group("Watching a run (docs/debugging.md)");
}

/// What \p Check accepts, without its name in --help.
CLI::Validator quietly(CLI::Validator Check) { return Check.description(""); }

void declareLaunch(CLI::App &App, Options &O) {
  App.add_option("--kernel", O.Kernel,
                 "the kernel to run, if the program has several")
      ->type_name("NAME")
      ->group("Running a kernel");
  App.add_option("--global", O.Global, "how many work-items run it")
      ->type_name("X[,Y[,Z]]")
      ->group("Running a kernel");
  App.add_option(
         "--local", O.Local,
         "work-items in a group (default: the kernel's own, or at most 64)")
      ->type_name("X[,Y[,Z]]")
      ->group("Running a kernel");
  App.add_option("--arg", O.Args,
                 "the next argument: i32:N u32:N i64:N u64:N f32:X bytes:HEX\n"
                 "buf:SIZE buf@FILE out:SIZE@FILE inout:FILE[@FILE] local:SIZE")
      ->type_name("ARG")
      ->group("Running a kernel")
      ->allow_extra_args(false);
  takesFile(
      App.add_option("--args", O.ArgsFile,
                     "all of this as JSON: {\"kernel\", \"global\", \"local\", "
                     "\"args\": [\"i32:5\", ...]}"))
      ->group("Running a kernel")
      ->excludes("--kernel")
      ->excludes("--global")
      ->excludes("--local")
      ->excludes("--arg");
  App.add_flag("--list-kernels", O.ListKernels,
               "print the program's kernels and exit")
      ->group("Running a kernel");
}

void declareTestPrograms(CLI::App &App, Options &O) {
  App.add_flag("--one-hart", O.OneHart, "one core of one warp of one lane")
      ->group("Test programs (docs/abi.md)");
  writesFile(App.add_option("--signature", O.SignatureFile,
                            "write the words from begin_signature to "
                            "end_signature"))
      ->group("Test programs (docs/abi.md)");
  App.add_option("--signature-granularity", O.SignatureGranularity,
                 "bytes a line of it (default: 4)")
      ->type_name("N")
      ->group("Test programs (docs/abi.md)")
      ->check(isOneOf({"1", "2", "4", "8", "16"}));
}

void declare(CLI::App &App, Options &O) {
  App.formatter(std::make_shared<HelpFormatter>());
  App.set_help_flag("-h,--help", "print this and exit");
  App.set_version_flag(
      "--version", [] { return versionLine(Tool); },
      "print the version and exit");
  takesFile(App.add_option("program", O.Program,
                           "RISC-V executable, Vortex's .vxbin, or a saved "
                           "region"))
      ->type_name("");
  App.add_option("--set", O.Set,
                 "change the configuration (raster.queue_depth=8; else "
                 "VORION_SET)")
      ->type_name("KEY=VALUE,...")
      ->allow_extra_args(false);
  App.add_flag("--print-config-schema", O.PrintSchema,
               "print the JSON schema of configurations and exit");
  App.add_option("--config", O.ConfigText,
                 "the machine: its name, or a configuration, JSON (else "
                 "VORION_CONFIG)");
  takesFile(App.get_option("--config"), {".json"})->type_name("NAME|FILE");
  App.add_flag("--print-default-config", O.PrintDefaultConfig,
               "print a configuration to start from, and exit");
  App.add_flag("--print-timing-parameters", O.PrintTiming,
               "print what --time goes by, with sources, and exit");
  App.add_flag("--time", O.Time,
               "say how long the run takes on the machine (docs/model.md)");
  App.add_option("--clock", O.ClockMhz,
                 "the machine's clock for --time (default: 530)")
      ->type_name("MHZ")
      ->check(quietly(isBetween(1U, 100000U)));
  App.add_flag("--energy", O.Energy,
               "say how long, and how much energy it takes (docs/energy.md)");
  takesFile(App.add_option("--technology", O.TechnologyFile,
                           "energies and areas for --energy (default: 16 nm)"),
            {".json"});
  App.add_option(
         "--voltage", O.Volts,
         "the chip's voltage for --energy (default: what the clock needs)")
      ->type_name("V")
      ->check(quietly(isBetween(0.1, 5.0)));
  App.add_flag("--print-technology", O.PrintTechnology,
               "print the default technology to start from, and exit");
  App.add_flag("--print-energy-parameters", O.PrintEnergy,
               "print what --energy goes by, with sources, and exit");
  App.add_option("--max-instructions", O.MaxInstructions,
                 "end the run after N warp instructions")
      ->type_name("N");
  App.add_option("--threads", O.Threads,
                 "host threads (default: all; changes no result)")
      ->type_name("N");
  declareLaunch(App, O);
  declareTestPrograms(App, O);
  for (const SessionOption &S : sessionOptions())
    declareWatch(App, S, O.Watch.*S.Text);
  App.footer(std::string(ExitCodeHelp) +
             "\na program that exits with N above 0 ends this with N, too, or "
             "with 1 if N is in the\nlist or above 255");
}

/// Arguments that begin with a plus are options too, as test frameworks write
/// them: +signature=FILE is --signature=FILE.
std::vector<std::string> argumentsOf(int Argc, char **Argv) {
  std::vector<std::string> Arguments;
  for (int N = 1; N < Argc; ++N) {
    const std::string_view Text = Argv[N];
    Arguments.push_back(Text.starts_with("+signature")
                            ? fmt::format("--{}", Text.substr(1))
                            : std::string(Text));
  }
  return Arguments;
}

int mainOf(int Argc, char **Argv) {
  CLI::App App{"Runs a program for the Vorion machine on the ISA simulator.",
               std::string(Tool)};
  Options O;
  declare(App, O);
  if (const auto Ended = parseCommandLine(App, argumentsOf(Argc, Argv)))
    return *Ended;
  if (O.PrintSchema) {
    printOut("{}", configSchema());
    return 0;
  }
  if (O.PrintDefaultConfig) {
    const Expected<Config> C = makeConfig(O, defaultMachine());
    if (!C)
      return reportError(Tool, C.error());
    printOut("{}", toJson(*C));
    return 0;
  }
  if (O.PrintTiming) {
    printOut("{}", timingMarkdown());
    return 0;
  }
  if (O.PrintTechnology) {
    printOut("{}", defaultTechnologyText());
    return 0;
  }
  if (O.PrintEnergy) {
    printOut("{}", energyMarkdown(defaultTechnology()));
    return 0;
  }
  if (O.Program.empty())
    return reportError(Tool, Error{"",
                                   "no program, expected an ELF file (see "
                                   "--help)",
                                   ExitCode::Usage});
  return run(O);
}

} // namespace

int main(int Argc, char **Argv) {
  return runTool(Tool, [&] { return mainOf(Argc, Argv); });
}
