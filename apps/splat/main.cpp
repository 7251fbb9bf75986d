// splat: renders 3D Gaussian scenes on an OpenCL device.

#include "commands/Commands.h"
#include "commands/Progress.h"
#include "device/Programs.h"
#include "io/Cameras.h"
#include "io/ReportHead.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Tool.h"
#include "vorion/support/Version.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace {

using namespace vorion;

/// The line of every tool, with ", programs 0123456789abcdef".
std::string programsText() {
  const auto Programs = splat::hashPrograms();
  return fmt::format("{}, programs {}", versionLine("splat"),
                     Programs ? *Programs : Programs.error().What);
}

/// For completion in shells: the views of a file of cameras, one a line.
int printViews(const std::string &File) {
  const auto Cameras = splat::readCameras(File);
  if (!Cameras)
    return reportError("splat", Cameras.error());
  for (const splat::Camera &C : *Cameras)
    printOut("{}\n", C.Name);
  return EXIT_SUCCESS;
}

constexpr std::string_view HardCases = "hard-cases";

/// Runs the program that has the catalogue of hard cases in place of this one,
/// with all words of \p Arguments but the command's; returns if it cannot.
int runHardCases(std::vector<std::string> Arguments) {
  Arguments.erase(std::ranges::find(Arguments, HardCases));
  if (!Arguments.empty() && Arguments.front() == "help")
    Arguments = {"--help"};
  const std::string Name = fmt::format("splat-{}", HardCases);
  std::error_code Ignored;
  const std::string Program =
      (std::filesystem::read_symlink("/proc/self/exe", Ignored).parent_path() /
       Name)
          .string();
  Arguments.insert(Arguments.begin(), Name);
  std::vector<char *> Words;
  Words.reserve(Arguments.size() + 1);
  for (std::string &Word : Arguments)
    Words.push_back(Word.data());
  Words.push_back(nullptr);
  execv(Program.c_str(), Words.data());
  return reportError("splat",
                     {Program,
                      fmt::format("cannot start: {}, expected the program "
                                  "that is installed with splat",
                                  std::strerror(errno)),
                      ExitCode::InputFile});
}

int run(std::vector<std::string> Arguments) {
  CLI::App App("Renders 3D Gaussian scenes on an OpenCL device.", "splat");
  App.footer(std::string(ExitCodeHelp));
  App.require_subcommand(1);
  App.set_version_flag("--version", programsText,
                       "Print the version, and a hash of all programs that "
                       "results depend on");
  splat::DeviceOptions Device;
  App.add_option_function<std::string>(
         "--set",
         [&](const std::string &Set) {
           Device.set("VORION_SET", Set, "--set");
         },
         "change the Vorion device's configuration, as cores=16, "
         "rasterizers=4, "
         "lanes=32, dram=lpddr5-6400 or any key of vorion-sim "
         "--print-default-config (as VORION_SET)")
      ->type_name("KEY=VALUE,...");
  App.add_flag_callback("--quiet", splat::hideProgress,
                        "Say nothing of how far a run is");
  // After a command, too.
  App.fallthrough();

  std::vector<std::pair<CLI::App *, splat::Runner>> Commands;
  const auto Add = [&](const char *Name, const char *Description,
                       splat::Runner (*Declare)(CLI::App &)) {
    CLI::App *Command = App.add_subcommand(Name, Description);
    Command->footer(std::string(ExitCodeHelp));
    Commands.emplace_back(Command, Declare(*Command));
  };
  Add("render", "Renders views of a scene", splat::addRender);
  Add("view", "Shows a scene on a page of this computer, drawn frame by frame",
      splat::addView);
  Add("gradients", "Takes a loss's gradients back from one view to a scene",
      splat::addGradients);
  Add("analyze", "Counts what a view of a scene asks of a machine",
      splat::addAnalyze);
  Add("accuracy", "Measures what accuracy costs in time", splat::addAccuracy);
  Add("effects", "Measures what it saves to compile only what a scene needs",
      splat::addEffects);
  Add("explore", "Tries machines: frames a second, energy and area",
      splat::addExplore);
  Add("info", "Prints what is in a scene or a capture", splat::addInfo);
  Add("convert", "Writes a scene in another format, and says what is lost",
      splat::addConvert);
  Add("demo-scene", "Writes the project's own scene and its cameras",
      splat::addDemoScene);
  Add("train", "Makes a scene from photographs with poses", splat::addTrain);
  Add("eval", "Judges a scene by the photographs of a capture", splat::addEval);
  Add("compare", "Compares two pictures, two lists of pairs or two times",
      splat::addCompare);
  Add("replay", "Runs again what made a report, and compares the bits",
      splat::addReplay);
  Add("doctor", "Looks for what keeps programs from working here",
      splat::addDoctor);

  App.add_subcommand(std::string(HardCases),
                     "Shows scenes whose numbers are hard, with and without "
                     "their guards");
  if (const CLI::App *Called = calledCommand(App, Arguments);
      (Called && Called->get_name() == HardCases) ||
      Arguments == std::vector<std::string>{"help", std::string(HardCases)})
    return runHardCases(std::move(Arguments));

  if (const auto Ended = parseCommandLine(App, std::move(Arguments)))
    return *Ended;
  for (auto &[Command, Run] : Commands)
    if (Command->parsed())
      if (const auto Done = Run(Device); !Done) {
        Error E = Done.error();
        E.What = Device.inOurWords(E.What); // of a process of its own
        return reportError("splat", E);
      }
  return EXIT_SUCCESS;
}

} // namespace

int main(int Count, char **Values) {
  return runTool("splat", [&] {
    const std::vector<std::string> Arguments(Values + 1, Values + Count);
    if (Arguments.size() == 2 && Arguments.front() == "--print-views")
      return printViews(Arguments.back());
    splat::setCommandLine(Arguments);
    return run(Arguments);
  });
}
