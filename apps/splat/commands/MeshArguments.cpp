#include "commands/MeshArguments.h"

#include "commands/PictureOptions.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace vorion::splat {

void addLightOption(CLI::App &App, std::optional<std::array<float, 3>> &Light) {
  const HelpGroup Group(App, "Scene");
  addVectorOption(
      App, "--light", "0.3,-1,0.5",
      [&Light](std::array<float, 3> Along) {
        const double Length = std::hypot(Along[0], Along[1], Along[2]);
        if (!(Length > 0 && Length < 1e30))
          throw CLI::ValidationError("--light", "expected a direction");
        for (float &Part : Along)
          Part = static_cast<float>(Part / Length);
        Light = Along;
      },
      "Direction in which a light shines on the mesh, by the world's axes "
      "(default: no light, colours as they are)")
      ->option_text("X,Y,Z");
}

void addMeshOptions(CLI::App &App, MeshArguments &A) {
  const HelpGroup Group(App, "Scene");
  takesFile(App.add_option("--mesh", A.File,
                           "Mesh of triangles that is drawn with the "
                           "Gaussians: .obj, .ply, .glb or .gltf "
                           "(docs/meshes.md)"),
            {".obj", ".ply", ".glb", ".gltf"});
  addLightOption(App, A.Light);
}

Error lightWithoutMesh() {
  return {"", "--light shines on a mesh, expected --mesh", ExitCode::Usage};
}

std::vector<std::string> wordsOf(const MeshArguments &A) {
  std::vector<std::string> Words;
  if (!A.File.empty())
    Words.insert(Words.end(), {"--mesh", A.File});
  if (A.Light)
    Words.push_back(fmt::format("--light={}", fmt::join(*A.Light, ",")));
  return Words;
}

Expected<Mesh> loadMesh(const std::string &Path) {
  auto Read = readMesh(Path);
  if (Read)
    for (const MeshWarning &W : Read->Warnings)
      printDiagnostic("splat", "warning", W.Where, W.What);
  return Read;
}

Expected<std::shared_ptr<const Mesh>> loadAddedMesh(const MeshArguments &A) {
  if (A.File.empty())
    return std::shared_ptr<const Mesh>();
  auto Read = loadMesh(A.File);
  if (!Read)
    return Read.error();
  return std::make_shared<const Mesh>(std::move(*Read));
}

Expected<std::shared_ptr<const Mesh>> loadOwnMesh(const SceneArguments &A,
                                                  const SceneFile &Scene) {
  if (Scene.Meshes == 0)
    return std::shared_ptr<const Mesh>();
  const auto Change = axesChangeOf(A);
  if (!Change)
    return Change.error();
  auto Read = loadMesh(A.Path);
  if (!Read)
    return Read.error();
  changeAxes(*Read, *Change);
  return std::make_shared<const Mesh>(std::move(*Read));
}

} // namespace vorion::splat
