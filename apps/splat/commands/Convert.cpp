#include "commands/Commands.h"
#include "commands/OutputFile.h"
#include "commands/SceneArguments.h"
#include "scene/formats/Ply.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"

#include <fmt/format.h>
#include <memory>
#include <string>

namespace vorion::splat {

Runner addConvert(CLI::App &App) {
  struct Arguments {
    SceneArguments Scene;
    std::string Output;
  };
  auto A = std::make_shared<Arguments>();
  addSceneOptions(App, A->Scene);
  App.add_option("-o,--output", A->Output,
                 "Scene to write (.ply, as INRIA has it)")
      ->required();
  return [A](const DeviceOptions &) -> Expected<Success> {
    if (auto Checked = checkEnding("-o", A->Output, {".ply"}); !Checked)
      return Checked;
    if (auto Claimed =
            claimOutputs({{"-o", A->Output}}, {{"the scene", A->Scene.Path}});
        !Claimed)
      return Claimed;
    const auto File = loadScene(A->Scene);
    if (!File)
      return File.error();
    if (auto Written = writePly(A->Output, File->Gaussians, File->DrawnAs);
        !Written)
      return Written.error();
    printOut("{}: {} Gaussians, SH degree {}{}\n", escaped(A->Output),
             File->Gaussians.size(), File->Gaussians.ShDegree,
             File->DrawnAs.Antialiased ? ", trained antialiased" : "");
    return Success{};
  };
}

} // namespace vorion::splat
