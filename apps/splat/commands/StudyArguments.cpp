#include "commands/StudyArguments.h"

#include "commands/OutputFile.h"
#include "commands/Progress.h"
#include "io/Hash.h"
#include "io/Inside.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"

#include <fmt/format.h>
#include <set>

namespace vorion::splat {

void addStudyOptions(CLI::App &App, StudyOptions &S, const std::string &What,
                     const std::string &Default) {
  const HelpGroup Group(App, "Study");
  writesFolder(App.add_option(
      "-o,--output", S.Folder,
      fmt::format(
          "Folder for measurements and page; existing measurements of the same "
          "inputs are reused (default: {}, in the current folder)",
          Default)));
  App.add_option(
         "--jobs", S.Jobs,
         fmt::format("Number of {}s that are measured in parallel", What))
      ->check(isBetween(1U, 256U))
      ->option_text("N");
  App.add_flag(
      "--list", S.List,
      fmt::format("Print the missing {}s, one per line, and measure none",
                  What));
  App.add_option("--only", S.Only,
                 fmt::format("Measure only this {}, named as --list prints it, "
                             "and write no page",
                             What))
      ->option_text(upperCase(What))
      ->allow_extra_args(false)
      ->excludes("--list");
  addFiguresOption(App, S.Figures)->excludes("--list")->excludes("--only");
}

/// That no view's files would take another's place.
static Expected<Success> checkNames(const std::vector<Camera> &Views,
                                    const std::string &File) {
  std::set<std::string> Names;
  for (const Camera &View : Views)
    if (!Names.insert(asFileName(View.Name)).second)
      return Error{File,
                   fmt::format("two of the views would be stored as {}, "
                               "expected views with different names",
                               asFileName(View.Name)),
                   ExitCode::Usage};
  return Success{};
}

static Expected<std::vector<Camera>> chosenViews(CameraArguments C,
                                                 const SceneArguments &S) {
  if (C.Views.empty())
    C.Views = {"all"};
  // Only a motion and a view that is found look at the scene.
  if (!C.File.empty() && C.Orbit == 0)
    return chooseCameras(C, SceneFile());
  const auto File = loadScene(S);
  return File ? chooseCameras(C, *File)
              : Expected<std::vector<Camera>>(File.error());
}

Expected<std::vector<Camera>> studyViews(CameraArguments C,
                                         const SceneArguments &S,
                                         const std::string &File) {
  auto Views = chosenViews(std::move(C), S);
  if (!Views)
    return Views;
  if (auto Checked = checkNames(*Views, File); !Checked)
    return Checked.error();
  return Views;
}

Expected<Provenance> sceneProvenance(const SceneArguments &S,
                                     const DeviceOptions &Machine) {
  auto From = commonProvenance(Machine);
  if (!From)
    return From;
  auto Scene = hashScene(S.Path);
  if (!Scene)
    return Scene.error();
  (*From)["scene"] = std::move(*Scene);
  return From;
}

std::vector<CLI::Option *> optionsFrom(CLI::App &App, std::size_t First) {
  const std::vector<CLI::Option *> All = App.get_options();
  return {All.begin() + static_cast<std::ptrdiff_t>(First), All.end()};
}

Expected<Success> writeStudy(const std::string &Folder, const std::string &Name,
                             const nlohmann::ordered_json &Report,
                             const std::string &Page) {
  if (auto Written =
          writeFileAtomically(Folder + "/" + Name, jsonText(Report, 1) + "\n");
      !Written)
    return Written;
  return writeFileAtomically(Folder + "/index.html", Page);
}

Expected<Success> writeStudyFigures(const StudyOptions &O) {
  return O.Figures.empty() ? Expected<Success>(Success{})
                           : writeFigures(O.Folder + "/index.html", O.Figures);
}

void logStudy(std::string_view Line) {
  if (!isProgressHidden())
    printNote(fmt::format("splat: {}\n", escaped(Line)));
}

} // namespace vorion::splat
