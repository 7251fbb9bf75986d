#include "tools/Options.h"
#include "vorion/support/ClockText.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::isasim {

namespace {

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
}

void declareLaunch(CLI::App &App, Options &O) {
  App.add_option("--kernel", O.Kernel,
                 "the kernel to run, if the program has several")
      ->type_name("NAME");
  App.add_option("--global", O.Global, "number of work-items")
      ->type_name("X[,Y[,Z]]");
  App.add_option("--local", O.Local,
                 "work-group size (default: the kernel's own, or at most 64)")
      ->type_name("X[,Y[,Z]]");
  App.add_option("--arg", O.Args,
                 "the next argument: i32:N u32:N i64:N u64:N f32:X bytes:HEX\n"
                 "buf:SIZE buf@FILE out:SIZE@FILE inout:FILE[@FILE] local:SIZE")
      ->type_name("ARG")
      ->allow_extra_args(false);
  takesFile(App.add_option("--args", O.ArgsFile,
                           "the options of this group as JSON: {\"kernel\", "
                           "\"global\", \"local\", "
                           "\"args\": [\"i32:5\", ...]}"))
      ->excludes("--kernel")
      ->excludes("--global")
      ->excludes("--local")
      ->excludes("--arg");
  App.add_flag("--list-kernels", O.ListKernels,
               "print the program's kernels and exit");
}

void declareTestPrograms(CLI::App &App, Options &O) {
  App.add_flag("--one-hart", O.OneHart, "one core of one warp of one lane");
  writesFile(App.add_option(
      "--signature", O.SignatureFile,
      "write the memory words from begin_signature to end_signature"));
  App.add_option("--signature-granularity", O.SignatureGranularity,
                 "bytes per line of the signature (default: 4)")
      ->type_name("N")
      ->check(isOneOf({"1", "2", "4", "8", "16"}));
}

} // namespace

void declareOptions(CLI::App &App, Options &O) {
  App.set_help_flag("-h,--help", "print this help and exit");
  App.set_version_flag(
      "--version", [&App] { return versionLine(App.get_name()); },
      "print the version and exit");
  takesFile(App.add_option("program", O.Program,
                           "RISC-V executable, Vortex's .vxbin, or a saved "
                           "region"))
      ->type_name("");
  HelpGroup Group(App, "Machine");
  App.add_option("--set", O.Set,
                 "override configuration keys, e.g. queue_depth=8,cores=16 "
                 "(default: VORION_SET)")
      ->type_name("KEY=VALUE,...")
      ->allow_extra_args(false);
  App.add_option(
      "--config", O.ConfigText,
      "the machine: a name, or a JSON configuration (default: VORION_CONFIG)");
  takesFile(App.get_option("--config"), {".json"})->type_name("NAME|FILE");
  Group.next("Time and energy");
  App.add_flag("--time", O.Time,
               "report the modelled execution time (docs/model.md)");
  App.add_option(
         "--clock", O.ClockMhz,
         "clock frequency of the timing model (default: the machine's, 530)")
      ->type_name("MHZ")
      ->check(isBetween(1U, MostClockMhz));
  App.add_flag(
      "--energy", O.Energy,
      "report the modelled execution time and energy (docs/energy.md)");
  takesFile(App.add_option("--technology", O.TechnologyFile,
                           "energies and areas of a process node (implies "
                           "--energy; default: 16 nm)"),
            {".json"});
  App.add_option("--voltage", O.Volts,
                 "supply voltage (implies --energy; default: what the clock "
                 "frequency needs)")
      ->type_name("V");
  Group.next("Printed instead of a run");
  App.add_flag("--print-default-config", O.PrintDefaultConfig,
               "print the default configuration and exit");
  App.add_flag("--print-config-schema", O.PrintSchema,
               "print the JSON schema of configurations and exit");
  App.add_flag("--print-timing-parameters", O.PrintTiming,
               "print the parameters of the timing model and the short names "
               "of --set, and exit");
  App.add_flag("--print-technology", O.PrintTechnology,
               "print the default technology file and exit");
  App.add_flag(
      "--print-energy-parameters", O.PrintEnergy,
      "print the parameters of the energy model with their sources, and exit");
  Group.next("Running a kernel");
  declareLaunch(App, O);
  Group.next("Test programs (docs/test-programs.md)");
  declareTestPrograms(App, O);
  Group.next("Observing a run (docs/debugging.md)");
  for (const SessionOption &S : sessionOptions())
    declareWatch(App, S, O.Watch.*S.Text);
  App.footer(std::string(ExitCodeHelp) +
             "\na nonzero exit code of the program is passed on, or replaced "
             "by 1 if it is in this\nlist or above 255");
}

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

} // namespace vorion::isasim
