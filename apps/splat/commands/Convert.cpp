#include "commands/Commands.h"
#include "commands/OutputFile.h"
#include "commands/SceneArguments.h"
#include "scene/SceneWriter.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <string>
#include <vector>

namespace vorion::splat {

namespace {

/// What the file does not have of the scene that was read.
void printLoss(const std::string &Path, const WrittenScene &W, const Scene &S,
               const Drawing &D) {
  if (!W.KeepsDrawing)
    printDiagnostic("splat", "warning", Path,
                    fmt::format("the file cannot say how the scene is drawn, "
                                "expected {}{} with it",
                                D.Antialiased ? "--antialiased" : "",
                                D.Dilation
                                    ? fmt::format(" --dilation {}", *D.Dilation)
                                    : ""));
  const struct {
    const char *Name;
    double Most;
  } Parts[] = {{"position", W.Lost.Position}, {"log scale", W.Lost.LogScale},
               {"rotation", W.Lost.Rotation}, {"opacity", W.Lost.Opacity},
               {"colour", W.Lost.Color},      {"harmonics", W.Lost.Harmonics}};
  std::vector<std::string> Lost;
  for (const auto &[Name, Most] : Parts)
    if (Most > 0)
      Lost.push_back(fmt::format("{} {:.2g}", Name, Most));
  if (W.ShDegree < S.ShDegree)
    Lost.push_back(
        fmt::format("harmonics above degree {} are dropped", W.ShDegree));
  printOut("{}\n", Lost.empty() ? "nothing is lost"
                                : fmt::format("lost at most: {}",
                                              fmt::join(Lost, ", ")));
}

} // namespace

Runner addConvert(CLI::App &App) {
  struct Arguments {
    SceneArguments Scene;
    std::string Output;
  };
  auto A = std::make_shared<Arguments>();
  addSceneOptions(App, A->Scene);
  writesFile(App.add_option(
                 "-o,--output", A->Output,
                 fmt::format("Scene to write, in the format of its ending: "
                             "{} (.ply is INRIA's PLY, which keeps every bit)",
                             fmt::join(writtenEndings(), ", "))),
             {writtenEndings().begin(), writtenEndings().end()})
      ->required();
  return [A](const DeviceOptions &) -> Expected<Success> {
    if (auto Checked = checkEnding("-o", A->Output, writtenEndings()); !Checked)
      return Checked;
    if (auto Claimed =
            claimOutputs({{"-o", A->Output}}, {{"the scene", A->Scene.Path}});
        !Claimed)
      return Claimed;
    const auto File = loadScene(A->Scene);
    if (!File)
      return File.error();
    const auto Written = writeScene(A->Output, File->Gaussians, File->DrawnAs);
    if (!Written)
      return Written.error();
    printOut("{}: {} Gaussians, SH degree {}{}\n", escaped(A->Output),
             File->Gaussians.size(), Written->ShDegree,
             File->DrawnAs.Antialiased ? ", trained antialiased" : "");
    printLoss(A->Output, *Written, File->Gaussians, File->DrawnAs);
    return Success{};
  };
}

} // namespace vorion::splat
