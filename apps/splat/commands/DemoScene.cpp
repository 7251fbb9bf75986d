#include "demo/DemoScene.h"
#include "demo/BenchmarkScene.h"

#include "commands/Commands.h"
#include "commands/OutputFile.h"
#include "io/Hash.h"
#include "io/ReportHead.h"
#include "scene/formats/Ply.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

namespace {

struct DemoArguments {
  std::string Output = "demo.ply", Cameras, JsonFile;
  int Gaussians = demo::DefaultGaussians;
  std::optional<demo::BenchmarkKind> Benchmark; ///< none: the still life
};

struct MadeScene {
  Scene Gaussians;
  std::vector<Camera> Cameras;
};

MadeScene make(const DemoArguments &A) {
  if (!A.Benchmark)
    return {demo::makeScene(A.Gaussians), demo::makeCameras()};
  const demo::BenchmarkShape &Shape =
      demo::benchmarkShape(*A.Benchmark, A.Gaussians);
  return {demo::makeBenchmark(*A.Benchmark, Shape, A.Gaussians),
          demo::benchmarkCameras(*A.Benchmark, Shape.distances())};
}

/// \p Hash: of the scene's file.
std::string jsonReport(const Scene &S, const std::string &Hash,
                       const std::vector<Camera> &Cameras) {
  using Json = nlohmann::ordered_json;
  Json Views = Json::array();
  for (const Camera &C : Cameras)
    Views.push_back({{"name", C.Name}, {"resolution", {C.Width, C.Height}}});
  Json Report = reportHead("splat-demo-scene");
  Report.update({{"gaussians", S.size()},
                 {"sh_degree", S.ShDegree},
                 {"views", std::move(Views)},
                 {"result_fnv1a64", Hash}});
  return jsonText(Report, 2) + "\n";
}

Expected<Success> run(const DemoArguments &A) {
  for (const auto &Checked : {checkEnding("-o", A.Output, {".ply"}),
                              checkEnding("--cameras", A.Cameras, {".json"}),
                              checkJsonName(A.JsonFile)})
    if (!Checked)
      return Checked;
  if (auto Claimed = claimOutputs(
          {{"-o", A.Output}, {"--cameras", A.Cameras}, {"--json", A.JsonFile}});
      !Claimed)
    return Claimed;
  const auto [S, Cameras] = make(A);
  const std::string File = formatPly(S);
  if (auto Written = writeFileAtomically(A.Output, File); !Written)
    return Written;
  printOut("{}: {}, SH degree {}\n", escaped(A.Output),
           counted(S.size(), "Gaussian"), S.ShDegree);
  if (!A.JsonFile.empty())
    if (auto Written = writeFileAtomically(
            A.JsonFile, jsonReport(S, fnv1a64(File), Cameras));
        !Written)
      return Written;
  if (A.Cameras.empty())
    return Success{};
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
  writesFile(App.add_option("--json", A->JsonFile, "Write a report as JSON"),
             {".json"});
  App.add_option("--gaussians", A->Gaussians,
                 fmt::format("Approximate number of Gaussians (default {})",
                             demo::DefaultGaussians))
      ->check(isBetween(demo::FewestGaussians, demo::MostGaussians));
  using demo::BenchmarkKinds;
  std::vector<std::string> Names(std::size(BenchmarkKinds));
  std::ranges::transform(BenchmarkKinds, Names.begin(),
                         [](demo::BenchmarkKind K) { return name(K); });
  App.add_option_function<std::string>(
         "--benchmark",
         [A](const std::string &Chosen) {
           A->Benchmark = *std::ranges::find(BenchmarkKinds, Chosen,
                                             [](auto K) { return name(K); });
         },
         "Generate a scene of the benchmark set instead, whose lists, "
         "occlusion and alpha are those of real scenes "
         "(docs/tables/benchmark-set.md)")
      ->option_text(fmt::format("{}", fmt::join(Names, "|")))
      ->check(isOneOf(Names));
  return [A](const DeviceOptions &) { return run(*A); };
}

} // namespace vorion::splat
