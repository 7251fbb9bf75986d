#include "commands/CaptureInfo.h"
#include "commands/Commands.h"
#include "commands/DeviceArguments.h"
#include "commands/InputFiles.h"
#include "commands/OutputFile.h"
#include "commands/PictureOptions.h"
#include "commands/Progress.h"
#include "commands/SceneArguments.h"

#include "eval/ScorePage.h"
#include "eval/ScoreText.h"
#include "io/Hash.h"
#include "io/ReportHead.h"
#include "picture/SceneUnit.h"
#include "picture/View.h"
#include "render/Pictures.h"
#include "scene/LocalFrame.h"
#include "train/data/Start.h"
#include "train/run/RunRecord.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/StatusLine.h"

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

namespace vorion::splat {
namespace {

struct EvalArguments : DrawArguments {
  SceneArguments Scene;
  std::string Capture;
  CaptureOptions Read;
  int Downscale = 1;
  bool All = false;
  std::string Json, Csv, Pictures, Device, KernelFolder;
  PageFiles Page;
};

/// What can be said to be wrong before anything is read.
Expected<Success> check(const EvalArguments &A) {
  for (const auto &Checked :
       {checkDrawOptions(A.Options),
        checkRenderer(A.Options, A.Scene.Options.Drawn), checkJsonName(A.Json),
        checkEnding("--csv", A.Csv, {".csv"}), checkPage(A.Page)})
    if (!Checked)
      return Checked;
  for (const float V : A.Options.Background)
    if (!(V >= 0 && V <= 1))
      return Error{"",
                   fmt::format("--background {}: expected values from 0 to 1, "
                               "the range of photographs",
                               V),
                   ExitCode::Usage};
  if (A.Read.HoldOut == 0U && !A.All)
    return Error{"", "--hold-out 0 leaves no view to evaluate, expected --all",
                 ExitCode::Usage};
  if (!A.Pictures.empty())
    if (auto Checked = checkPrefix("--pictures", A.Pictures); !Checked)
      return Checked;
  return claimOutputs(
      {{"--json", A.Json}, {"--csv", A.Csv}, {"--html", A.Page.Html}},
      InputFiles().watched().scene(A.Scene.Path).capture(A.Capture).named());
}

Expected<nlohmann::ordered_json>
reportOf(const EvalArguments &A, const SceneFile &File, const Capture &C,
         const TrainingSet &Set, const Device &D,
         const std::vector<ViewScore> &Scores) {
  const auto SceneHash = hashScene(A.Scene.Path);
  if (!SceneHash)
    return SceneHash.error();
  nlohmann::ordered_json Report = reportHead("splat-eval");
  Report.update({{"scene",
                  {{"file", A.Scene.Path},
                   {"fnv1a64", *SceneHash},
                   {"gaussians", File.Gaussians.size()}}},
                 {"capture", A.Capture},
                 {"capture_format", name(C.Format)},
                 {"pictures", hashPictures(Set)},
                 {"downscale", A.Downscale},
                 {"picture_filter", PhotoFilter},
                 {"through_lenses", A.Read.Pictures == LensOf::Photograph},
                 {"masks", name(A.Read.Masks)},
                 {"held_out_by", C.HeldOutBy},
                 {"rules", name(A.Options.Convention)},
                 {"support", name(A.Options.Reach)},
                 {"path", name(A.Options.Blending)},
                 {"renderer", name(A.Options.Kind)},
                 {"falloff_degree", A.Options.FalloffDegree},
                 {"antialiased", A.Options.Antialiased},
                 {"dilation", A.Options.Dilation},
                 {"background", A.Options.Background},
                 {"device", {{"name", D.name()}, {"version", D.version()}}}});
  Report.update(scoreJson(Scores));
  return Report;
}

Expected<Success> writeScores(const EvalArguments &A, const Device &D,
                              const std::vector<JudgedView> &Views,
                              const std::vector<ViewScore> &Scores) {
  const auto Hash = hashScene(A.Scene.Path);
  if (!Hash)
    return Hash.error();
  const auto Page =
      scorePageOf({std::filesystem::path(A.Scene.Path).filename().string(),
                   {madeBy(),
                    fmt::format("scene {}, fnv1a64 {}; capture {}",
                                A.Scene.Path, *Hash, A.Capture),
                    fmt::format("device {}, {}", D.name(), D.version())}},
                  Views, Scores);
  return Page ? writePage(A.Page, *Page) : Expected<Success>(Page.error());
}

Expected<Success> run(EvalArguments &A, const DeviceOptions &Machine) {
  if (auto Checked = check(A); !Checked)
    return Checked;
  auto File = loadScene(A.Scene);
  if (!File)
    return File.error();
  drawByFile(A.Options, File->DrawnAs, File->Gaussians);
  for (const auto &Checked :
       {checkRenderer(A.Options, A.Scene.Options.Drawn),
        checkFalloff(A.Options.Kind, A.Scene.Options.Drawn.FalloffDegree)})
    if (!Checked)
      return Checked;
  const auto C = readCapture(A.Capture, A.Read);
  if (!C)
    return C.error();
  const LoadOptions Load{.Downscale = A.Downscale,
                         .Background = A.Options.Background,
                         .Masks = A.Read.Masks,
                         .Pictures = A.Read.Pictures};
  const auto Set = loadTrainingSet(*C, Load);
  if (!Set)
    return Set.error();
  if (!A.Options.Near)
    A.Options.Near =
        nearOfSmallScene(A.Options.Convention, C->poses(), sampleOf(*C));
  const std::vector<JudgedView> Views = judgedViews(*Set, A.All);
  if (Views.empty())
    return Error{A.Capture, "no held-out view, expected at least one, or --all",
                 ExitCode::Usage};
  std::vector<Camera> Cameras;
  Cameras.reserve(Views.size());
  for (const JudgedView &V : Views)
    Cameras.push_back(V.View->Pose);
  if (auto Through = drawThrough(A.Options, A.Capture, Cameras); !Through)
    return Through;
  if (auto Checked = checkRays(A.Options, A.Capture); !Checked)
    return Checked;
  recentre(File->Gaussians, Cameras);
  const ViewFacts Facts = factsOfAll(File->Gaussians, Cameras, A.Options);
  hintAtNear(A.Options, Facts);
  const EffectInputs Inputs{.Gaussians = File->Gaussians,
                            .Options = A.Options,
                            .Facts = Facts,
                            .Machine = Machine,
                            .Views = Views.size()};
  const RenderPlan Plan = planRender(EffectPlan(A.Request, Inputs), A.Options);
  warnOfMissing(Plan.Effects, A.Effects);

  auto D = openDevice(A.Device, A.Options.Blending, Machine);
  if (!D)
    return D.error();
  Launcher L(*D, A.KernelFolder, progressOf(Views.size()));
  const auto Scores = evaluate(L, Plan, File->Gaussians, A.Options, Views);
  clearStatus();
  if (!Scores) {
    showBuildLog(L);
    return Scores.error();
  }
  L.recordBuilds();
  if (!A.Csv.empty())
    if (auto Written = writeFileAtomically(A.Csv, scoreCsv(*Scores)); !Written)
      return Written;
  if (!A.Pictures.empty())
    if (auto Written = writePairFiles(A.Pictures, Views, *Scores); !Written)
      return Written;
  if (A.Page.any())
    if (auto Written = writeScores(A, *D, Views, *Scores); !Written)
      return Written;
  if (!A.Json.empty()) {
    const auto Report = reportOf(A, *File, *C, *Set, *D, *Scores);
    if (!Report)
      return Report.error();
    if (auto Written = writeFileAtomically(A.Json, jsonText(*Report, 2) + "\n");
        !Written)
      return Written;
  }
  printOut("{}{}{}\n", readerLines(C->Notes, C->WithoutPicture),
           scoreTable(*Scores), NoLpips);
  return Success{};
}

} // namespace

Runner addEval(CLI::App &App) {
  auto A = std::make_shared<EvalArguments>();
  addSceneOptions(App, A->Scene);
  takesFile(
      App.add_option(
          "capture", A->Capture,
          "Photographs with poses, in any format that `splat train` reads"))
      ->required();
  HelpGroup Group(App, "Photographs");
  App.add_flag(
      "--all", A->All,
      "Evaluate the training views, too (default: only the held-out views)");
  App.add_flag(
      "--distorted",
      [A](std::int64_t) { A->Read.Pictures = LensOf::Photograph; },
      "Render with the lens distortion of the photographs and compare with the "
      "original photographs (default: compare with undistorted photographs)");
  App.add_option(
         "--downscale", A->Downscale,
         "Downsampling factor of the photographs, as in training (default 1)")
      ->check(isBetween(1, 64));
  App.add_option("--exclude", A->Read.Exclude,
                 "Exclude this picture; may be repeated")
      ->allow_extra_args(false);
  addHoldOutOption(App, A->Read.HoldOut);
  addPlaceOptions(App, A->Read);
  addMasksOption(App, A->Read.Masks);
  Group.next("Output");
  writesFile(App.add_option("--json", A->Json, "Write the scores as JSON"),
             {".json"});
  writesFile(App.add_option("--csv", A->Csv, "Write one line per view"),
             {".csv"});
  writesFiles(
      App.add_option("--pictures", A->Pictures,
                     "Write each rendered view and its photograph as "
                     "PREFIX.NAME.drawn.png and PREFIX.NAME.photo.png"));
  addPageOptions(App, A->Page,
                 "Write a page with these pictures and their scores");
  addDrawOptions(App, *A);
  addRendererOption(App, A->Options.Kind, A->Scene.Options.Drawn);
  addDeviceOption(App, A->Device);
  addKernelsOption(App, A->KernelFolder);
  return [A](const DeviceOptions &Machine) {
    if (auto Parsed = parseDrawTexts(*A); !Parsed)
      return Parsed;
    return run(*A, Machine);
  };
}

} // namespace vorion::splat
