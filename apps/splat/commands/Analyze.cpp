#include "analyze/Analysis.h"
#include "analyze/OrderAnalysis.h"
#include "analyze/Plots.h"
#include "analyze/ToReference.h"
#include "cameras/CameraFile.h"
#include "commands/CameraArguments.h"
#include "commands/Choices.h"
#include "commands/Commands.h"
#include "commands/InputFiles.h"
#include "commands/OutputFile.h"
#include "commands/SceneArguments.h"
#include "io/Cameras.h"
#include "io/Hash.h"
#include "io/ReportHead.h"
#include "page/VerdictPage.h"
#include "picture/Options.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

struct AnalyzeArguments {
  SceneArguments Scene;
  CameraArguments Cameras;
  std::string View, OrderBeside, JsonFile;
  PageFiles Page;
  Rules Convention = Rules::Inria;
  Support Reach = Support::Square3;
  reference::Options Options;
};

Json json(const Invocations &I) {
  Json J;
  for (std::size_t K = 0; K < I.size(); ++K)
    J[std::to_string(AnalyzedTiles[K])] = I[K];
  return J;
}

Json json(const Distribution &D) {
  return {{"count", D.Count}, {"mean", D.Mean}, {"percentiles", D.Percentiles}};
}

Json json(const ListStatistics &L) {
  return {{"tiles", L.Tiles},
          {"empty", L.Empty},
          {"mean", L.Mean},
          {"max", L.Longest},
          {"histogram_by_bits", L.Histogram},
          {"filled", json(L.Filled)},
          {"occluded_by_percent", L.Occluded}};
}

/// As JSON has no infinity, an equal picture's dB is null.
Json json(const OrderChange &C) {
  return {{"turned", C.Turned},
          {"psnr_db", std::isfinite(C.Db) ? Json(C.Db) : Json()}};
}

/// What the counts come from.
struct InputHashes {
  std::string Scene, Cameras;
};

Expected<InputHashes> hashInputs(const AnalyzeArguments &A) {
  const auto Scene = hashScene(A.Scene.Path);
  if (!Scene)
    return Scene.error();
  Expected<std::string> Cameras = fnv1a64({}); // where none are read
  if (!A.Cameras.File.empty())
    Cameras = hashCameraFile(A.Cameras.File);
  if (!Cameras)
    return Cameras.error();
  return InputHashes{*Scene, *Cameras};
}

std::string jsonReport(const AnalyzeArguments &A, const SceneFile &F,
                       const InputHashes &Hashes, const Camera &C,
                       const Analysis &R,
                       const std::optional<OrderAnalysis> &Order) {
  Json BySupport, Lists;
  for (std::size_t K = 0; K < AnalyzedSupports.size(); ++K)
    BySupport[std::string(name(AnalyzedSupports[K]))] = json(R.BySupport[K]);
  for (std::size_t K = 0; K < AnalyzedTiles.size(); ++K)
    Lists[std::to_string(AnalyzedTiles[K])] = json(R.Lists[K]);
  const double Pixels = static_cast<double>(R.Pixels);
  Json Report = reportHead("splat-analyze");
  Report.update(
      {{"scene",
        {{"file", A.Scene.Path},
         {"fnv1a64", Hashes.Scene},
         {"gaussians", F.Gaussians.size()},
         {"dropped_nonfinite", F.Dropped},
         {"sh_degree", F.Gaussians.ShDegree},
         {"format", name(F.Format)},
         {"axes_changed", A.Scene.Axes}}},
       {"cameras", {{"file", A.Cameras.File}, {"fnv1a64", Hashes.Cameras}}},
       {"view", C.Name},
       {"resolution", {C.Width, C.Height}},
       {"rules", name(A.Convention)},
       {"support", name(A.Reach)},
       {"antialiased", A.Options.Antialiased},
       {"antialiased_by", F.DrawnAs.Source},
       {"dilation", A.Options.Dilation},
       {"cutoff", A.Options.Cutoff},
       {"visible", R.Visible},
       {"invocations", json(R.BySupport[static_cast<std::size_t>(A.Reach)])},
       {"invocations_by_support", BySupport},
       {"lists", Lists},
       {"blends_per_pixel", static_cast<double>(R.Blends) / Pixels},
       {"covered_share", static_cast<double>(R.Covered) / Pixels},
       {"saturated_share", static_cast<double>(R.Saturated) / Pixels},
       {"mean_transmittance", R.MeanTransmittance},
       {"blends", json(R.BlendsEach)},
       {"walked", json(R.WalkedEach)},
       {"alpha", json(R.Alpha)}});
  if (Order)
    Report["order"] = {{"beside", A.OrderBeside},
                       {"pairs", Order->Pairs},
                       {"by_other_view", json(Order->ByOtherView)},
                       {"along_rays", json(Order->AlongRays)}};
  return jsonText(Report, 2) + "\n";
}

std::string textReport(const AnalyzeArguments &A, const Camera &C,
                       const Analysis &R) {
  const double Pixels = static_cast<double>(R.Pixels);
  std::string Text = fmt::format(
      "{} {}x{}: {} rules, support {}\n{} seen, {:.2f} blends per pixel, "
      "{:.2f} % saturated\n{:<22}",
      escaped(C.Name), C.Width, C.Height, name(A.Convention), name(A.Reach),
      counted(R.Visible, "Gaussian"), static_cast<double>(R.Blends) / Pixels,
      100 * static_cast<double>(R.Saturated) / Pixels, "tile size (pixels)");
  for (const int Size : AnalyzedTiles)
    Text += fmt::format("{:>12}", Size);
  Text += fmt::format("{:>16}\n", "16 to 64");
  for (std::size_t K = 0; K < AnalyzedSupports.size(); ++K) {
    Text += fmt::format("invocations {:<10}", name(AnalyzedSupports[K]));
    for (const uint64_t Count : R.BySupport[K])
      Text += fmt::format("{:>12}", Count);
    Text +=
        fmt::format("{:>14.1f} %\n", -100 * reduction(R.BySupport[K], 0, 2));
  }
  const auto Row = [&](const char *Name, auto Value) {
    Text += fmt::format("{:<22}", Name);
    for (const ListStatistics &L : R.Lists)
      Text += fmt::format("{:>12.1f}", static_cast<double>(Value(L)));
    Text += '\n';
  };
  Row("entries per tile, mean", [](const auto &L) { return L.Mean; });
  Row("entries per tile, max.", [](const auto &L) { return L.Longest; });
  for (const std::size_t Percent : {25, 50, 75, 100})
    Row(fmt::format("occluded at {} % (%)", Percent).c_str(),
        [&](const auto &L) { return 100 * L.Occluded[Percent]; });
  Text += fmt::format("{:<22}{:>12}{:>12}{:>12}\n", "where there are any",
                      "mean", "median", "95 %");
  const auto Spread = [&](const char *Name, const Distribution &D) {
    Text += fmt::format("{:<22}{:>12.3f}{:>12.3f}{:>12.3f}\n", Name, D.Mean,
                        D.Percentiles[50], D.Percentiles[95]);
  };
  Spread("blends of a pixel", R.BlendsEach);
  Spread("entries it visits", R.WalkedEach);
  Spread("alpha of a blend", R.Alpha);
  return Text;
}

std::string textOf(const std::string &Beside, const OrderAnalysis &O) {
  const auto Line = [&](const std::string &By, const OrderChange &C) {
    return fmt::format("{:<22}{:>12} of {} pixel-Gaussian pairs change order "
                       "({:.3f} %), PSNR {:.2f} dB\n",
                       By, C.Turned, O.Pairs,
                       O.Pairs == 0 ? 0
                                    : 100 * static_cast<double>(C.Turned) /
                                          static_cast<double>(O.Pairs),
                       C.Db);
  };
  return Line("order of " + escaped(Beside), O.ByOtherView) +
         Line("order along rays", O.AlongRays);
}

/// The cameras that are analyzed, of one size: the view's, and that of
/// --order-beside.
struct AnalyzedCameras {
  Camera View;
  std::optional<Camera> Beside;
};

Expected<AnalyzedCameras> camerasOf(AnalyzeArguments &A, SceneFile &S) {
  if (!A.View.empty())
    A.Cameras.Views = {A.View};
  std::optional<float> Near;
  const auto Chosen = camerasToDraw(A.Cameras, S, A.Convention, Near);
  if (!Chosen)
    return Chosen.error();
  A.Options = toReference(S.DrawnAs);
  A.Options.Near = double{Near.value_or(0)};
  AnalyzedCameras C{Chosen->front(), std::nullopt};
  if (A.OrderBeside.empty())
    return C;
  CameraArguments Other = A.Cameras;
  Other.Views = {A.OrderBeside};
  const auto Beside = chooseCameras(Other, S);
  if (!Beside)
    return Beside.error();
  C.Beside = Beside->front();
  for (const Camera *Of : {&C.View, &*C.Beside})
    if (Of->Optics != CameraModel())
      return Error{
          A.Cameras.File,
          fmt::format("--order-beside: view {} has the camera model "
                      "{}{}, expected PINHOLE",
                      printable(Of->Name), Of->Optics.Model->Name,
                      Of->Optics.Shutter ? " and a rolling shutter" : ""),
          ExitCode::Usage};
  return C;
}

/// The last part of \p Path, which may end in a slash.
std::string sceneName(const std::string &Path) {
  const std::filesystem::path P(Path);
  return (P.has_filename() ? P : P.parent_path()).filename().string();
}

/// The counts by tile size.
AnswerTable tableOf(const Analysis &R) {
  AnswerTable T{"Counts by tile size", "", {"tile size, pixels"}, {}};
  for (const int Size : AnalyzedTiles)
    T.Columns.push_back(std::to_string(Size));
  const auto Row = [&T](std::string Name, const auto &Values,
                        const auto &Text) {
    std::vector<std::string> Cells{std::move(Name)};
    for (const auto &V : Values)
      Cells.push_back(Text(V));
    T.Rows.push_back(std::move(Cells));
  };
  for (std::size_t K = 0; K < AnalyzedSupports.size(); ++K)
    Row(fmt::format("invocations, {}", name(AnalyzedSupports[K])),
        R.BySupport[K], [](uint64_t Count) { return std::to_string(Count); });
  Row("entries per tile, mean", R.Lists,
      [](const ListStatistics &L) { return fmt::format("{:.1f}", L.Mean); });
  Row("entries per tile, maximum", R.Lists,
      [](const ListStatistics &L) { return std::to_string(L.Longest); });
  for (const std::size_t Percent : {25, 50, 75, 100})
    Row(fmt::format("occluded at {} %, %", Percent), R.Lists,
        [Percent](const ListStatistics &L) {
          return fmt::format("{:.1f}", 100 * L.Occluded[Percent]);
        });
  return T;
}

std::string pageOf(const AnalyzeArguments &A, const InputHashes &Hashes,
                   const Camera &C, const Analysis &R) {
  VerdictPage Page{
      "Workload of a view",
      fmt::format("{} of {}: {} seen, {} blends, {} rules, support {}.",
                  printable(C.Name), sceneName(A.Scene.Path),
                  counted(R.Visible, "Gaussian"), R.Blends, name(A.Convention),
                  name(A.Reach)),
      {},
      {},
      {tableOf(R)},
      {madeBy(),
       fmt::format("scene {}, fnv1a64 {}; cameras {}, fnv1a64 {}", A.Scene.Path,
                   Hashes.Scene, A.Cameras.File, Hashes.Cameras)}};
  for (auto &[Name, Plot] : chartsOf(R))
    Page.Charts.push_back(std::move(Plot));
  return verdictPageOf(Page);
}

Expected<Success> run(AnalyzeArguments A) {
  for (const auto &Checked : {checkJsonName(A.JsonFile), checkPage(A.Page)})
    if (!Checked)
      return Checked;
  if (auto Claimed = claimOutputs(
          {{"--json", A.JsonFile}, {"--html", A.Page.Html}},
          InputFiles().scene(A.Scene.Path).cameras(A.Cameras.File).named());
      !Claimed)
    return Claimed;
  auto File = loadScene(A.Scene);
  if (!File)
    return File.error();
  const auto Cameras = camerasOf(A, *File);
  if (!Cameras)
    return Cameras.error();
  const Camera &C = Cameras->View;
  A.Options.Rule = toReference(A.Convention);
  A.Options.Reach = toReference(A.Reach);
  const Scene &S = File->Gaussians;
  const Analysis R =
      analyze(toReference<float>(S),
              toReference<float>(relativeTo(C, S.Origin)), A.Options);
  std::optional<OrderAnalysis> Order;
  if (Cameras->Beside)
    Order = analyzeOrder(
        toReference<double>(S), toReference<double>(relativeTo(C, S.Origin)),
        toReference<double>(relativeTo(*Cameras->Beside, S.Origin)), A.Options);
  if (!A.JsonFile.empty() || A.Page.any()) {
    const auto Hashes = hashInputs(A);
    if (!Hashes)
      return Hashes.error();
    if (!A.JsonFile.empty())
      if (auto Written = writeFileAtomically(
              A.JsonFile, jsonReport(A, *File, *Hashes, C, R, Order));
          !Written)
        return Written;
    if (auto Written = writePage(A.Page, pageOf(A, *Hashes, C, R)); !Written)
      return Written;
  }
  printOut("{}", textReport(A, C, R));
  if (Order)
    printOut("{}", textOf(A.OrderBeside, *Order));
  return Success{};
}

} // namespace

Runner addAnalyze(CLI::App &App) {
  auto A = std::make_shared<AnalyzeArguments>();
  addSceneOptions(App, A->Scene);
  addCameraOptions(App, A->Cameras, /*Several=*/false);
  takesView(App.add_option("--view", A->View,
                           "Name or number of the view (default: the first)"));
  takesView(App.add_option("--order-beside", A->OrderBeside,
                           "Count the Gaussians of each pixel whose blend "
                           "order differs in this view's order, and in the "
                           "order along the pixel's ray (docs/numerics.md)"));
  addSizeOption(App, A->Cameras);
  writesFile(App.add_option("--json", A->JsonFile, "Write all counts"),
             {".json"});
  addPageOptions(App, A->Page, "Write a page with charts of the counts");
  addChoice(App, "--rules", A->Convention, {Rules::Inria, Rules::Gsplat},
            "Rendering convention");
  addChoice(
      App, "--support", A->Reach,
      {Support::Exact, Support::Box3, Support::Square3, Support::Official16},
      "Rule for the pixels that a Gaussian covers, for lists and occlusion");
  App.add_option(
         "--cutoff", A->Options.Cutoff,
         "Transmittance below which a pixel is saturated (default 0.0001)")
      ->check(isBetween(0.0, 1.0));
  App.add_option("--threads", A->Options.Threads,
                 "Host threads (0: all); results do not depend on it")
      ->check(isBetween(0U, 1024U));
  return [A](const DeviceOptions &) { return run(*A); };
}

} // namespace vorion::splat
