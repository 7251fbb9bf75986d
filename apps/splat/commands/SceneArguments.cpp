#include "commands/SceneArguments.h"

#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <future>
#include <string_view>
#include <vector>

namespace vorion::splat {

void addSceneOptions(CLI::App &App, SceneArguments &A) {
  const HelpGroup Group(App, "Scene");
  std::vector<std::string_view> Titles;
  std::vector<std::string> Endings;
  for (const SceneFormatRecord &F : sceneFormats()) {
    Titles.push_back(F.Title);
    if (!F.Ending.empty())
      Endings.emplace_back(F.Ending);
  }
  takesFile(App.add_option("scene", A.Path,
                           fmt::format("Scene: {}", fmt::join(Titles, ", "))),
            Endings)
      ->required();
  App.add_option("--axes", A.Axes,
                 "Convert the scene's coordinate axes between two conventions, "
                 "e.g. rub:rdf (default: no conversion)")
      ->option_text("FROM:TO");
  App.add_option("--lod", A.Options.LevelOfDetail,
                 "Level of detail of a streamed scene (default 0, the finest)")
      ->check(isBetween(0, 1000));
  App.add_flag("--drop-nonfinite", A.Options.DropNonFinite,
               "Drop Gaussians with a NaN or an infinity, and report their "
               "number (default: they are an error)");
  std::optional<bool> &Antialiased = A.Options.Drawn.Antialiased;
  App.add_flag_function(
      "--antialiased,!--no-antialiased",
      [&Antialiased](std::int64_t Sum) {
        if (Sum == 0)
          throw CLI::ValidationError(
              "--antialiased", "given with --no-antialiased, expected one of "
                               "them");
        Antialiased = Sum > 0;
      },
      "Compensate opacities for the dilation, or not (default: as recorded in "
      "the scene's file, else off)");
  App.add_option("--dilation", A.Options.Drawn.Dilation,
                 "Variance added to both axes of a projected Gaussian "
                 "(default: as recorded in the scene's file, else 0.3)")
      ->option_text("PX2");
}

static Expected<SceneFile> readMeanwhile(const SceneArguments &A,
                                         const std::function<void()> &Other) {
  auto Reading = std::async(std::launch::async,
                            [&A] { return readScene(A.Path, A.Options); });
  Other();
  return Reading.get();
}

Expected<AxesChange> axesChangeOf(const SceneArguments &A) {
  return A.Axes.empty() ? Expected(AxesChange{})
                        : parseAxesChange("--axes", A.Axes);
}

Expected<SceneFile> loadScene(const SceneArguments &A,
                              const std::function<void()> &Meanwhile) {
  if (const auto Dilation = A.Options.Drawn.Dilation;
      Dilation && !isDilation(*Dilation))
    return Error{
        "",
        fmt::format("--dilation {}: expected {}", *Dilation, ExpectedDilation),
        ExitCode::Usage};
  const auto Change = axesChangeOf(A);
  if (!Change)
    return Change.error();
  auto File =
      Meanwhile ? readMeanwhile(A, Meanwhile) : readScene(A.Path, A.Options);
  if (!File)
    return File;
  changeAxes(File->Gaussians, *Change);
  if (File->Up)
    for (std::size_t K = 0; K < 3; ++K)
      (*File->Up)[K] *= Change->From[K] * Change->To[K];
  if (!File->Skipped.empty()) {
    // A long list helps nobody.
    constexpr std::size_t MostNamed = 12;
    const std::size_t Named = std::min(File->Skipped.size(), MostNamed);
    std::vector<std::string> Names;
    Names.reserve(Named);
    for (std::size_t I = 0; I < Named; ++I)
      Names.push_back(printable(File->Skipped[I]));
    printDiagnostic(
        "splat", "warning", A.Path,
        fmt::format(
            "ignores properties that no effect reads: {}{}",
            fmt::join(Names, ", "),
            Named == File->Skipped.size()
                ? ""
                : fmt::format(" and {} more", File->Skipped.size() - Named)));
  }
  if (File->Meshes > 0 && !A.KeepsMeshes)
    printDiagnostic("splat", "warning", A.Path,
                    fmt::format("ignores {} without Gaussians, which splat "
                                "render draws",
                                counted(File->Meshes, "primitive")));
  if (File->ReducedFrom > 0)
    printDiagnostic("splat", "warning", A.Path,
                    fmt::format("has spherical harmonics of degree {}: those "
                                "above degree {} are ignored",
                                File->ReducedFrom, MaxShDegree));
  if (File->Dropped > 0)
    printDiagnostic(
        "splat", "warning", A.Path,
        fmt::format("drops {} of {} Gaussians, which have a NaN or an infinity",
                    File->Dropped, File->Dropped + File->Gaussians.size()));
  return File;
}

std::vector<std::string> wordsOf(const SceneArguments &A) {
  std::vector<std::string> Words;
  if (!A.Axes.empty())
    Words.insert(Words.end(), {"--axes", A.Axes});
  if (A.Options.LevelOfDetail != 0)
    Words.insert(Words.end(),
                 {"--lod", std::to_string(A.Options.LevelOfDetail)});
  if (A.Options.DropNonFinite)
    Words.emplace_back("--drop-nonfinite");
  if (const auto Asked = A.Options.Drawn.Antialiased)
    Words.emplace_back(*Asked ? "--antialiased" : "--no-antialiased");
  if (const auto Asked = A.Options.Drawn.Dilation)
    Words.insert(Words.end(), {"--dilation", fmt::format("{}", *Asked)});
  return Words;
}

} // namespace vorion::splat
