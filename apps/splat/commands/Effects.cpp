#include "cameras/CameraFile.h"
#include "commands/CameraArguments.h"
#include "commands/Commands.h"
#include "commands/DeviceArguments.h"
#include "commands/InputFiles.h"
#include "commands/OutputFile.h"
#include "commands/PictureOptions.h"
#include "commands/Progress.h"
#include "commands/SceneArguments.h"
#include "device/ClockedMachine.h"
#include "io/Hash.h"
#include "io/ReportHead.h"
#include "page/VerdictPage.h"
#include "picture/View.h"
#include "render/EffectCosts.h"
#include "render/Pictures.h"
#include "render/Plan.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"
#include "vorion/support/StatusLine.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

struct EffectsArguments : DrawArguments {
  SceneArguments Scene;
  CameraArguments Cameras;
  std::string Json, Device, KernelFolder;
  PageFiles Page;
  unsigned Runs = 3;
  bool Each = false;
};

/// What was found of a view.
struct EffectsFound {
  const EffectsArguments &A;
  const Camera &View;
  std::vector<ModeCost> Modes;
  /// Those that data decide: what auto compiles in, and what it leaves out.
  std::vector<std::string> Needed, NotNeeded;
  std::optional<EffectCosts> Each;
};

Expected<Success> check(const EffectsArguments &A) {
  if (!A.Cameras.isOne())
    return Error{"", "effects are measured on one view, expected one --view",
                 ExitCode::Usage};
  for (const auto &Checked :
       {checkJsonName(A.Json), checkPage(A.Page), checkDrawOptions(A.Options)})
    if (!Checked)
      return Checked;
  return claimOutputs({{"--json", A.Json}, {"--html", A.Page.Html}},
                      InputFiles()
                          .watched()
                          .scene(A.Scene.Path)
                          .cameras(A.Cameras.File)
                          .named());
}

std::string more(uint64_t Value, uint64_t Base) {
  return fmt::format(
      "{:+.1f} %",
      100 * (static_cast<double>(Value) / static_cast<double>(Base) - 1));
}

/// The host's seconds of \p M beside those of \p Base: nothing is said of runs
/// whose ranges overlap.
std::string hostChange(const ModeCost &M, const ModeCost &Base) {
  const bool Apart = M.Seconds.front() > Base.Seconds.back() ||
                     M.Seconds.back() < Base.Seconds.front();
  return Apart
             ? fmt::format("{:+.0f} %", 100 * (M.median() / Base.median() - 1))
             : "within noise";
}

AnswerTable tableOf(const EffectsFound &F) {
  AnswerTable T{"Three ways to choose effects",
                fmt::format("Changes are relative to auto; cycles are of {}.\n"
                            "Host seconds are processor time of the frame "
                            "without the clock, the median of {} with their "
                            "range.",
                            F.Modes.front().On, counted(F.A.Runs, "run")),
                {"effects", "cycles", "", "warp instr.", "", "host s", "range",
                 "", "picture"},
                {}};
  const ModeCost &Base = F.Modes.front();
  for (const ModeCost &M : F.Modes) {
    const bool IsBase = &M == &Base;
    T.Rows.push_back(
        {std::string(name(M.Selection)), fmt::format("{}", M.Cycles),
         IsBase ? "" : more(M.Cycles, Base.Cycles),
         fmt::format("{}", M.Instructions),
         IsBase ? "" : more(M.Instructions, Base.Instructions),
         fmt::format("{:.3f}", M.median()),
         fmt::format("{:.3f} to {:.3f}", M.Seconds.front(), M.Seconds.back()),
         IsBase ? "" : hostChange(M, Base),
         IsBase                ? M.Hash
         : M.Hash == Base.Hash ? "bit-identical"
                               : M.Hash});
  }
  return T;
}

std::string list(const std::vector<std::string> &Names) {
  return Names.empty() ? "none" : fmt::format("{}", fmt::join(Names, ", "));
}

std::string textOf(const EffectsFound &F) {
  const AnswerTable T = tableOf(F);
  return fmt::format("{}\n\n{}{}\nauto compiles in: {}\nauto leaves out: {}\n"
                     "(splat render --explain shows the reason for each)\n{}",
                     verdictOf(F.Modes), toString(T), T.Note, list(F.Needed),
                     list(F.NotNeeded), F.Each ? "\n" + toString(*F.Each) : "");
}

Expected<Json> jsonOf(const EffectsFound &F) {
  const auto SceneHash = hashScene(F.A.Scene.Path);
  if (!SceneHash)
    return SceneHash.error();
  Json Cameras;
  if (!F.A.Cameras.File.empty()) {
    const auto Hash = hashCameraFile(F.A.Cameras.File);
    if (!Hash)
      return Hash.error();
    Cameras = {{"file", F.A.Cameras.File}, {"fnv1a64", *Hash}};
  }
  Json Modes = Json::array();
  for (const ModeCost &M : F.Modes)
    Modes.push_back({{"effects", name(M.Selection)},
                     {"cycles", M.Cycles},
                     {"warp_instructions", M.Instructions},
                     {"seconds", M.Seconds},
                     {"same_bits", M.Hash == F.Modes.front().Hash},
                     {"result_fnv1a64", M.Hash}});
  Json Report = reportHead("splat-effects");
  Report.update({{"verdict", verdictOf(F.Modes)},
                 {"scene", {{"file", F.A.Scene.Path}, {"fnv1a64", *SceneHash}}},
                 {"cameras", std::move(Cameras)},
                 {"view", F.View.Name},
                 {"resolution", {F.View.Width, F.View.Height}},
                 {"path", name(F.A.Options.Blending)},
                 {ClockedMachineKey, F.Modes.front().On},
                 {"modes", std::move(Modes)},
                 {"needed", F.Needed},
                 {"not_needed", F.NotNeeded}});
  if (F.Each) {
    Json Each = Json::array();
    for (const EffectCost &C : F.Each->Effects)
      Each.push_back({{"name", C.Subject->Name},
                      {"on", C.Done},
                      {"warp_instructions", C.Instructions},
                      {"cycles", C.Cycles},
                      {"failure", C.Failure}});
    Report["each"] = std::move(Each);
  }
  return Report;
}

Expected<std::string> pageOf(const EffectsFound &F, const Image &Picture) {
  auto Png = encodePng(Picture);
  if (!Png)
    return Png.error();
  Chart Bars{.Title = "Cycles and warp instructions, % of auto's",
             .XLabel = "",
             .YLabel = "%",
             .Places = {},
             .Series = {{"cycles", {}}, {"warp instructions", {}}},
             .Bars = true};
  const ModeCost &Base = F.Modes.front();
  for (const ModeCost &M : F.Modes) {
    Bars.Places.emplace_back(name(M.Selection));
    Bars.Series[0].Values.push_back(100 * static_cast<double>(M.Cycles) /
                                    static_cast<double>(Base.Cycles));
    Bars.Series[1].Values.push_back(100 * static_cast<double>(M.Instructions) /
                                    static_cast<double>(Base.Instructions));
  }
  AnswerTable Chosen{"What auto compiles", "", {"", "effects"}, {}};
  Chosen.Rows = {{"compiled in", list(F.Needed)},
                 {"left out", list(F.NotNeeded)}};
  return verdictPageOf(
      {"Cost of effects that a scene does not need",
       verdictOf(F.Modes),
       {std::move(Bars)},
       {{"The picture",
         "Identical for all three selections unless the table says otherwise.",
         {{fmt::format("{}, view {}", escaped(F.A.Scene.Path),
                       printable(F.View.Name)),
           std::move(*Png)}}}},
       {tableOf(F), std::move(Chosen)},
       {madeBy()}});
}

Expected<Success> writeJson(const EffectsFound &F) {
  if (F.A.Json.empty())
    return Success{};
  const auto Report = jsonOf(F);
  return Report ? writeFileAtomically(F.A.Json, jsonText(*Report, 2) + "\n")
                : Expected<Success>(Report.error());
}

/// Draws the picture for it once more, in this process.
Expected<Success> writeModes(const EffectsFound &F, const DeviceOpener &Open,
                             const EffectInputs &In) {
  if (!F.A.Page.any())
    return Success{};
  const auto D = Open();
  if (!D)
    return D.error();
  Launcher L(*D, F.A.KernelFolder, {});
  const auto R = render(L, planRender(EffectPlan({}, In), In.Options),
                        In.Gaussians, F.View, In.Options, /*KeepPairs=*/false);
  if (!R)
    return R.error();
  const auto Page = pageOf(F, R->Picture);
  return Page ? writePage(F.A.Page, *Page) : Expected<Success>(Page.error());
}

Expected<Success> run(EffectsArguments &A, DeviceOptions Machine) {
  if (auto Checked = check(A); !Checked)
    return Checked;
  auto File = loadScene(A.Scene);
  if (!File)
    return File.error();
  drawAs(A.Options, File->DrawnAs);
  const auto Cameras =
      camerasToDraw(A.Cameras, *File, A.Options.Convention, A.Options.Near);
  if (!Cameras)
    return Cameras.error();
  if (auto Through = drawThrough(A.Options, A.Cameras.File, *Cameras); !Through)
    return Through;
  DeviceOptions Clocked = Machine;
  turnClockOn(Clocked, std::nullopt, "");
  Machine.set("VORION_TIME", "off");
  const auto OpenWith = [&A](const DeviceOptions &With) {
    return
        [&A, With] { return openDevice(A.Device, A.Options.Blending, With); };
  };
  const DeviceOpener OpenClocked = OpenWith(Clocked);
  const DeviceOpener OpenPlain = OpenWith(Machine);
  const ViewFacts Facts = factsOfAll(File->Gaussians, *Cameras, A.Options);
  EffectInputs In{File->Gaussians, A.Options, Facts};
  In.Machine = Machine;
  EffectsFound F{A, Cameras->front(), {}, {}, {}, {}};
  const auto Modes = measureModes(OpenClocked, OpenPlain, A.KernelFolder, In,
                                  F.View, A.Runs, progress());
  clearStatus();
  if (!Modes)
    return Modes.error();
  F.Modes = *Modes;
  const EffectPlan Auto({}, In);
  for (const EffectDecision &D : Auto.decisions())
    if (D.Subject->Kind == EffectKind::Scene && !D.Subject->ByCamera &&
        D.Detected.Applies)
      (D.Done ? F.Needed : F.NotNeeded).emplace_back(D.Subject->Name);
  if (A.Each) {
    auto Each =
        measureEffects(OpenClocked, A.KernelFolder, {}, In, F.View, progress());
    clearStatus();
    if (!Each)
      return Each.error();
    F.Each = std::move(*Each);
  }
  printOut("{}", textOf(F));
  if (auto Written = writeJson(F); !Written)
    return Written;
  return writeModes(F, OpenPlain, In);
}

} // namespace

Runner addEffects(CLI::App &App) {
  auto A = std::make_shared<EffectsArguments>();
  addSceneOptions(App, A->Scene);
  addCameraOptions(App, A->Cameras, /*Several=*/false);
  takesView(App.add_option("--view", A->Cameras.Views,
                           "Name or number of the view (default: the first)"))
      ->allow_extra_args(false);
  writesFile(App.add_option("--json", A->Json, "Write all figures"), {".json"});
  addPageOptions(App, A->Page, "Write a page with all figures and the picture");
  App.add_option(
         "--runs", A->Runs,
         "Number of runs without the timing model, for host times (default 3)")
      ->check(isBetween(1U, 1000U))
      ->option_text("N");
  App.add_flag(
      "--each", A->Each,
      "Also measure the cost of each effect by rendering with and without it");
  addDrawOptions(App, *A, /*Effects=*/false);
  addDeviceOption(App, A->Device);
  addKernelsOption(App, A->KernelFolder);
  return [A](const DeviceOptions &Machine) {
    if (auto Parsed = parseDrawTexts(*A); !Parsed)
      return Parsed;
    return run(*A, Machine);
  };
}

} // namespace vorion::splat
