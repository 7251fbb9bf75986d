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
  App.set_version_flag(
      "--version", programsText,
      "Print the version and a hash of all programs that affect results");
  splat::DeviceOptions Device;
  App.add_option_function<std::string>(
         "--set",
         [&](const std::string &Set) {
           Device.set("VORION_SET", Set, "--set");
         },
         "Override configuration keys of the Vorion device, e.g. "
         "cores=16,dram=lpddr5-6400; vorion-sim --print-default-config lists "
         "them (default: VORION_SET)")
      ->type_name("KEY=VALUE,...");
  App.add_flag_callback("--quiet", splat::hideProgress, "Do not show progress");
  // After a command, too.
  App.fallthrough();

  std::vector<std::pair<CLI::App *, splat::Runner>> Commands;
  const auto Add = [&](const char *Name, const char *Description,
                       splat::Runner (*Declare)(CLI::App &)) {
    CLI::App *Command = App.add_subcommand(Name, Description);
    Command->footer(std::string(ExitCodeHelp));
    Commands.emplace_back(Command, Declare(*Command));
    for (const std::string &Option : writingOptions(*Command))
      if (CLI::Option *O = Command->get_option(Option);
          O->get_group() == "Options")
        O->group("Output");
  };
  Add("render", "Renders views of a scene", splat::addRender);
  Add("view",
      "Serves an interactive viewer of a scene to a browser on this computer",
      splat::addView);
  Add("gradients",
      "Computes a loss's gradients with respect to a scene's parameters, for "
      "one view",
      splat::addGradients);
  Add("analyze", "Counts the rendering workload of one view of a scene",
      splat::addAnalyze);
  Add("accuracy", "Measures the trade-off between accuracy and frame time",
      splat::addAccuracy);
  Add("effects",
      "Measures the saving of compiling only the effects that a scene needs",
      splat::addEffects);
  Add("explore",
      "Explores the design space of machines: frame rate, energy and area",
      splat::addExplore);
  Add("info", "Prints the contents of a scene or a capture", splat::addInfo);
  Add("convert", "Converts a scene to another format, and reports what is lost",
      splat::addConvert);
  Add("demo-scene", "Writes the project's demo scene and its cameras",
      splat::addDemoScene);
  Add("capture",
      "Makes a capture from photographs or a video: finds their poses by "
      "COLMAP",
      splat::addCapture);
  Add("train", "Trains a scene from photographs with poses", splat::addTrain);
  Add("eval", "Evaluates a scene on the photographs of a capture (PSNR, SSIM)",
      splat::addEval);
  Add("compare",
      "Compares two pictures, two lists of tile-Gaussian pairs or two timings",
      splat::addCompare);
  Add("replay",
      "Repeats the command that wrote a report, and checks that the results "
      "are bit-identical",
      splat::addReplay);
  Add("doctor", "Diagnoses problems of this computer's set-up",
      splat::addDoctor);

  App.add_subcommand(std::string(HardCases),
                     "Renders numerically hard scenes, with and without the "
                     "guards in the kernels");
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
