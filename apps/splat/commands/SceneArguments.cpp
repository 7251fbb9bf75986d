#include "SceneArguments.h"

#include "../io/Axes.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorion::splat {

void addSceneOptions(CLI::App &App, SceneArguments &A) {
  App.add_option("scene", A.Path,
                 "Scene: INRIA's or compressed PLY, .splat, .spz, or SOG (zip "
                 "or folder)")
      ->required();
  App.add_option("--axes", A.Axes,
                 "Mirror the scene between conventions, as rub:rdf (default: "
                 "as the file has it)")
      ->option_text("FROM:TO");
  App.add_option("--lod", A.Options.LevelOfDetail,
                 "Level of detail of a streamed scene (default 0, the finest)")
      ->check(CLI::Range(0, 1000));
}

Expected<SceneFile> loadScene(const SceneArguments &A) {
  AxesChange Change;
  if (!A.Axes.empty()) {
    const auto Parsed = parseAxesChange("--axes", A.Axes);
    if (!Parsed)
      return Parsed.error();
    Change = *Parsed;
  }
  auto File = readScene(A.Path, A.Options);
  if (!File)
    return File;
  changeAxes(File->Gaussians, Change);
  if (!File->Skipped.empty())
    printDiagnostic("splat", "warning", A.Path,
                    escaped(fmt::format("skips properties that no effect here "
                                        "reads: {}",
                                        fmt::join(File->Skipped, ", "))));
  return File;
}

} // namespace vorion::splat
