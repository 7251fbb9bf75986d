#include "commands/Commands.h"
#include "commands/OutputFile.h"
#include "commands/SceneArguments.h"
#include "commands/SceneEdits.h"
#include "scene/Edit.h"
#include "scene/SceneWriter.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"

#include <filesystem>
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

/// Joins the scenes \p More with \p To, each read as the first was.
Expected<Success> joinOthers(const SceneArguments &First,
                             const std::vector<std::string> &More,
                             SceneFile &To) {
  for (const std::string &Path : More) {
    SceneArguments Other = First;
    Other.Path = Path;
    auto Read = loadScene(Other);
    if (!Read)
      return Read.error();
    if (!Read->DrawnAs.drawsAs(To.DrawnAs))
      return Error{Path, "is drawn another way than the scenes before it "
                         "(antialiased, dilation), expected --antialiased or "
                         "--no-antialiased, and --dilation, for all"};
    join(To.Gaussians, std::move(Read->Gaussians));
  }
  return Success{};
}

} // namespace

Runner addConvert(CLI::App &App) {
  struct Arguments {
    SceneArguments Scene;
    std::vector<std::string> More;
    std::string Output;
    SceneEdits Edits;
  };
  auto A = std::make_shared<Arguments>();
  addSceneOptions(App, A->Scene);
  takesFile(App.add_option("more", A->More, "Scenes that are joined with it"));
  writesFile(App.add_option(
                 "-o,--output", A->Output,
                 fmt::format("Scene to write, in the format of its ending: "
                             "{} (.ply is INRIA's PLY, which keeps every bit)",
                             fmt::join(writtenEndings(), ", "))),
             {writtenEndings().begin(), writtenEndings().end()})
      ->required();
  addEditOptions(App, A->Edits);
  return [A](const DeviceOptions &) -> Expected<Success> {
    if (auto Checked = checkEnding("-o", A->Output, writtenEndings()); !Checked)
      return Checked;
    // A folder's scene is the pictures beside this file.
    const auto IndexOf = [](const std::string &Path) {
      return (std::filesystem::path(Path) / "meta.json").string();
    };
    std::vector<NamedFile> Inputs{{"the scene", A->Scene.Path},
                                  {"the scene", IndexOf(A->Scene.Path)}};
    for (const std::string &Path : A->More)
      for (const std::string &File : {Path, IndexOf(Path)})
        Inputs.push_back({"the scene " + printable(Path), File});
    if (auto Claimed = claimOutputs({{"-o", A->Output}}, Inputs); !Claimed)
      return Claimed;
    auto File = loadScene(A->Scene);
    if (!File)
      return File.error();
    if (auto Joined = joinOthers(A->Scene, A->More, *File); !Joined)
      return Joined;
    const auto Said = editScene(File->Gaussians, A->Edits);
    if (!Said)
      return Said.error();
    for (const std::string &Line : *Said)
      printOut("{}\n", Line);
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
