// splat-fixture: turns a fixture into files that `splat render` reads.

#include "Convert.h"
#include "Gradients.h"
#include "Tool.h"
#include "io/Metrics.h"
#include "scene/formats/Ply.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::test {
namespace {

/// `view.npz` of the fixture's own result, so that `splat compare` can read it.
splat::Npz expectedOf(const Fixture &F) {
  splat::Npz Arrays;
  for (const auto &[From, To] :
       {std::pair("f64_render", "render"), std::pair("f64_alpha", "alpha"),
        std::pair("mask_threshold", "mask_threshold"),
        std::pair("mask_order", "mask_order")})
    if (F.has(From))
      Arrays[To] = F.Arrays.at(From);
  return Arrays;
}

Expected<Success> run(const std::string &Input, const std::string &Folder) {
  const auto F = readFixture(Input);
  if (!F)
    return F.error();
  std::error_code Failed;
  std::filesystem::create_directories(Folder, Failed);
  if (Failed)
    return Error{Folder, "cannot create the folder: " + Failed.message()};
  const splat::Scene S = sceneOf(*F);
  const splat::Camera C = cameraOf(*F);
  const auto &O = F->Options;

  // The same renderer on both sides: the difference is the conversion's.
  const auto Exact = reference::render(F->Gaussians, F->Camera, O);
  const auto Stored = reference::render(splat::toReference<double>(S),
                                        splat::toReference<double>(C), O);
  std::vector<uint8_t> Doubtful(Exact.Doubts);
  const auto Loss = splat::compare(renderOf(Exact), renderOf(Stored), 3);
  const auto Outside =
      splat::compare(renderOf(Exact), renderOf(Stored), 3, Doubtful);

  const nlohmann::ordered_json Options{
      {"rules", O.Rule == reference::Rules::Inria ? "inria" : "gsplat"},
      {"support", reference::name(O.Reach)},
      {"antialiased", O.Antialiased},
      {"background", O.Background},
      {"dilation", O.Dilation},
      {"conversion_db", Loss.PsnrDb},
      {"conversion_db_outside_doubtful", Outside.PsnrDb}};
  const std::string Prefix = Folder + "/";
  if (auto W = splat::writePly(Prefix + "scene.ply", S); !W)
    return W;
  if (auto W = splat::writeCameras(Prefix + "cameras.json", {C}); !W)
    return W;
  if (auto W = splat::writeNpz(Prefix + "expected.npz", expectedOf(*F)); !W)
    return W;
  if (auto W = splat::writeNpz(Prefix + "reference.npz", toNpz(Exact)); !W)
    return W;
  const GradientFiles Gradients = gradientsOf(*F, Doubtful);
  if (auto W = splat::writeNpz(Prefix + "upstream.npz", Gradients.Upstream); !W)
    return W;
  if (auto W = splat::writeNpz(Prefix + "gradients.npz", Gradients.Expected);
      !W)
    return W;
  if (auto W = writeFileAtomically(Prefix + "options.json",
                                   jsonText(Options, 2) + "\n");
      !W)
    return W;
  fmt::print("{}: {} Gaussians, {}x{}, {} rules, support {}{}\nconversion to "
             "fp32 logarithms and logits: {:.1f} dB, {:.1f} dB outside "
             "doubtful pixels ({:.3f} %)\n",
             F->Name, S.size(), C.Width, C.Height,
             Options["rules"].get<std::string>(), reference::name(O.Reach),
             O.Antialiased ? ", antialiased" : "", Loss.PsnrDb, Outside.PsnrDb,
             100 * Exact.doubtfulShare());
  return Success{};
}

} // namespace
} // namespace vorion::test

int main(int Count, char **Values) {
  CLI::App App("Converts a fixture to a scene (scene.ply), a view named view "
               "(cameras.json), its options (options.json), the expected "
               "result (expected.npz), the reference renderer's result with "
               "masks of doubtful pixels (reference.npz), the gradients of a "
               "loss that excludes doubtful pixels (upstream.npz), and the "
               "expected gradients of the scene (gradients.npz).",
               "splat-fixture");
  std::string Input, Folder;
  App.add_option("fixture", Input, "Fixture with inputs and results (.npz)")
      ->required();
  App.add_option("-o,--output", Folder,
                 "Output folder, created if it does not exist")
      ->required();
  return vorion::test::runTool(
      App, Count, Values, [&] { return vorion::test::run(Input, Folder); });
}
