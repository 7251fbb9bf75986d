#include "demo/DemoScene.h"

#include "commands/Commands.h"
#include "commands/OutputFile.h"
#include "scene/formats/Ply.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"

#include <fmt/format.h>
#include <memory>
#include <string>

namespace vorion::splat {

namespace {

struct DemoArguments {
  std::string Output = "demo.ply", Cameras;
  int Gaussians = demo::DefaultGaussians;
};

Expected<Success> run(const DemoArguments &A) {
  for (const auto &Checked : {checkEnding("-o", A.Output, {".ply"}),
                              checkEnding("--cameras", A.Cameras, {".json"})})
    if (!Checked)
      return Checked;
  if (auto Claimed = claimOutputs({{"-o", A.Output}, {"--cameras", A.Cameras}});
      !Claimed)
    return Claimed;
  const Scene S = demo::makeScene(A.Gaussians);
  if (auto Written = writePly(A.Output, S); !Written)
    return Written.error();
  printOut("{}: {} Gaussians, SH degree {}\n", escaped(A.Output), S.size(),
           S.ShDegree);
  if (A.Cameras.empty())
    return Success{};
  const std::vector<Camera> Cameras = demo::makeCameras();
  if (auto Written = writeCameras(A.Cameras, Cameras); !Written)
    return Written.error();
  for (const Camera &C : Cameras)
    printOut("{}: view {}, {}x{}\n", escaped(A.Cameras), C.Name, C.Width,
             C.Height);
  return Success{};
}

} // namespace

Runner addDemoScene(CLI::App &App) {
  auto A = std::make_shared<DemoArguments>();
  writesFile(App.add_option("-o,--output", A->Output,
                            "Scene to write (.ply; default demo.ply)"),
             {".ply"});
  writesFile(App.add_option("--cameras", A->Cameras,
                            "Write its views too (cameras.json)"),
             {".json"});
  App.add_option(
         "--gaussians", A->Gaussians,
         fmt::format("About how many (default {})", demo::DefaultGaussians))
      ->check(CLI::Range(demo::FewestGaussians, demo::MostGaussians));
  return [A](const DeviceOptions &) { return run(*A); };
}

} // namespace vorion::splat
