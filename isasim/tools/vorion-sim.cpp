/// Runs a program, or one kernel of it, on the simulated machine.

#include "timing/dram/TimingTable.h"
#include "tools/Arguments.h"
#include "tools/Launch.h"
#include "tools/Options.h"
#include "tools/RegionRun.h"
#include "tools/Signature.h"
#include "vorion/isasim/Energy.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Session.h"
#include "vorion/isasim/Variables.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Environment.h"
#include "vorion/support/File.h"
#include "vorion/support/Tool.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <fmt/ranges.h>
#include <memory>

using namespace vorion;
using namespace vorion::isasim;

namespace {

constexpr std::string_view Tool = "vorion-sim";

Expected<std::string> readText(const std::string &Path) {
  Expected<std::vector<std::byte>> Bytes = readFile(Path);
  if (!Bytes)
    return Bytes.error();
  return std::string(reinterpret_cast<const char *>(Bytes->data()),
                     Bytes->size());
}

/// \p Given, or the environment's \p Variable, which counts without it.
std::string orVariable(const std::string &Given, const char *Variable) {
  const char *Text = environmentVariable(Variable);
  return Given.empty() && Text ? Text : Given;
}

/// Naming a technology or a voltage asks, too.
bool wantsEnergy(const Options &O) {
  return O.Energy || !O.TechnologyFile.empty() || O.Volts;
}

Expected<Technology> technologyOf(const Options &O) {
  return O.TechnologyFile.empty() ? Expected<Technology>(defaultTechnology())
                                  : readTechnology(O.TechnologyFile);
}

/// Nothing if nobody wants to know.
Expected<std::shared_ptr<const EnergyModel>> makeEnergyModel(const Options &O,
                                                             const Config &C) {
  if (!wantsEnergy(O))
    return std::shared_ptr<const EnergyModel>();
  const Expected<Technology> From = technologyOf(O);
  if (!From)
    return From.error();
  Expected<EnergyModel> Made =
      EnergyModel::create(*From, C.Timing.ClockMhz, O.Volts);
  if (!Made)
    return Made.error();
  // Before the run rather than behind it: of one cycle, but with its DRAM.
  const EnergyWork Nothing{
      1,
      C.Timing.ClockMhz,
      {{"dram channels", dram::reportName(C.Timing.Dram.Standard),
        C.Timing.Dram.Channels}}};
  if (const auto Knows = Made->energyOf(Nothing); !Knows)
    return Knows.error();
  return std::make_shared<const EnergyModel>(std::move(*Made));
}

std::string settings(const Options &O) {
  return O.Set.empty() ? orVariable("", "VORION_SET")
                       : fmt::format("{}", fmt::join(O.Set, ","));
}

Expected<Success> changeValues(Config &C, const Options &O) {
  Expected<Success> Ok = setValues(C, settings(O));
  if (!Ok && O.Set.empty())
    return inVariable("VORION_SET", Ok.error());
  return Ok;
}

/// The machine that the options, and below them the environment, say; \p
/// Default where they name none.
Expected<Config> makeConfig(const Options &O, const Config &Default) {
  Config C = Default;
  const std::string Text = orVariable(O.ConfigText, "VORION_CONFIG");
  if (!Text.empty()) {
    const auto Named = [&O](const Error &E) {
      return O.ConfigText.empty() ? inVariable("VORION_CONFIG", E) : E;
    };
    const Expected<MachineSource> Found = findMachine(Text);
    if (!Found)
      return Named(Found.error());
    const Expected<Config> Parsed = parseConfig(Found->Json, Found->Where);
    if (!Parsed)
      return Named(Parsed.error());
    C = *Parsed;
  }
  if (O.OneHart)
    C.Clusters = C.SocketsPerCluster = C.CoresPerSocket = C.WarpsPerCore =
        C.LanesPerWarp = 1;
  const Config Before = C;
  if (const Expected<Success> Ok = changeValues(C, O); !Ok)
    return Ok.error();
  C.Timing.Enabled |=
      O.Time || O.ClockMhz || wantsEnergy(O) || O.Watch.needClock();
  if (O.ClockMhz)
    C.Timing.ClockMhz = *O.ClockMhz;
  if (!O.PrintDefaultConfig)
    for (const std::string &Idle : idleSettings(Before, C, settings(O)))
      printDiagnostic("vorion-sim", "note", "", Idle);
  return C;
}

/// \p E of a machine that variables describe where no option does.
Error ofMachine(Error E, const Options &O) {
  return isasim::ofMachine(
      std::move(E),
      O.ConfigText.empty() && !orVariable("", "VORION_CONFIG").empty(),
      O.Set.empty() && !orVariable("", "VORION_SET").empty());
}

Error wrongSizes(std::string_view Option, const std::string &Given) {
  return {"",
          fmt::format("{}: {}, expected X[,Y[,Z]], whole numbers above 0",
                      Option, Given),
          ExitCode::Usage};
}

Error missingGlobal() {
  return {"",
          "--global is missing, expected X[,Y[,Z]], the number of work-items",
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
    constexpr const char *Kinds[] = {"value", "global", "local", "integer",
                                     "float"};
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
/// kernel went unmapped memory.
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
    Report += "\n  --check bounds reports the buffer and the location of an "
              "out-of-bounds access";
  if (R.End == Outcome::GuestFailed)
    printDiagnostic(
        Tool, "error", O.Program,
        fmt::format("the program failed with exit code {}{}", R.ExitCode,
                    canPassOn(R.ExitCode)
                        ? ""
                        : ", for which vorion-sim exits with 1 (see --help)"));
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
  // However it ended: that is what people look for in a kernel that hangs.
  if (Launch)
    Launch->print();
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
      O.Watch, std::string(Tool), NamedBy::Nothing,
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
        Error{O.Program, fmt::format("a saved region, expected no {}", Given),
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
    return reportError(Tool, ofMachine(M.error(), O));
  if (const auto Attached = (*Watch)->attach(**M); !Attached)
    return reportError(Tool, Attached.error());
  const auto Last = runRegion(*Region, **M, **Watch, O.Watch.Region.empty(),
                              O.Program, printText);
  if (!Last)
    return reportError(Tool, Last.error());
  return lastWord(reportOutcome(*Last, O), **Watch);
}

int run(const Options &O) {
  warnOfMisspeltVariables(Tool);
  warnOfUnreadVariables(Tool);
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
  if (const Expected<Success> Fits =
          (*Program)->checkLanes(C->LanesPerWarp, Request->Kernel);
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
    return reportError(Tool, ofMachine(M.error(), O));
  (*M)->load(*Program);
  if (const auto Attached = (*Watch)->attach(**M); !Attached)
    return reportError(Tool, Attached.error());
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

int mainOf(int Argc, char **Argv) {
  CLI::App App{"Runs a program of the Vorion machine on the ISA simulator.",
               std::string(Tool)};
  Options O;
  declareOptions(App, O);
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
    printOut("{}{}", timingMarkdown(), shortKeysMarkdown());
    return 0;
  }
  if (O.PrintTechnology) {
    printOut("{}", defaultTechnologyText());
    return 0;
  }
  if (O.PrintEnergy) {
    const Expected<Technology> From = technologyOf(O);
    if (!From)
      return reportError(Tool, From.error());
    printOut("{}", energyMarkdown(*From));
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
