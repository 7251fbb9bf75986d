#include "commands/CameraArguments.h"
#include "commands/Choices.h"
#include "commands/Commands.h"
#include "commands/DeviceArguments.h"
#include "commands/EnergyArguments.h"
#include "commands/HeatMapFiles.h"
#include "commands/InputFiles.h"
#include "commands/LayerOptions.h"
#include "commands/NumericsReport.h"
#include "commands/OutputFile.h"
#include "commands/PictureOptions.h"
#include "commands/Progress.h"
#include "commands/SceneArguments.h"
#include "effects/Registry.h"

#include "io/Cameras.h"
#include "page/TimePage.h"
#include "picture/HeatMap.h"
#include "picture/View.h"
#include "render/EffectCosts.h"
#include "render/Explain.h"
#include "render/Fallback.h"
#include "render/FrameTime.h"
#include "render/Pictures.h"
#include "render/Report.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"
#include "vorion/support/StatusLine.h"

#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace vorion::splat {

namespace {

struct RenderArguments : DrawArguments {
  SceneArguments Scene;
  CameraArguments Cameras;
  std::string Output, CamerasOut;
  std::string Json, Html, Pairs, Device, KernelFolder;
  LayerFiles Layers;
  std::string Explain; ///< empty, "plan" or "measure"
  bool Time = false, Overlap = false;
  std::optional<unsigned> ClockMhz;
  EnergyArguments Energy;
  PictureFormat Format;
  std::string Numerics; ///< settings, empty for no
  std::string HeatMap;  ///< what names of files begin with, empty for no
};

bool isOne(const RenderArguments &A) { return A.Cameras.isOne(); }

/// Whether the device blends the lists more than once.
bool blendsAgain(const RenderArguments &A) {
  return A.Layers.needDepths() || A.Layers.needNormals();
}

/// What can be said to be wrong before anything is read.
Expected<Success> check(const RenderArguments &A) {
  const auto Usage = [](std::string What) {
    return Error{"", std::move(What), ExitCode::Usage};
  };
  const RenderOptions &O = A.Options;
  for (const auto &Checked :
       {checkEnding("-o", A.Output, pictureEndings()),
        checkEnding("--dump-pairs", A.Pairs, {".npz"}), checkJsonName(A.Json),
        checkEnding("--html", A.Html, {".html"}),
        checkEnding("--write-cameras", A.CamerasOut, {".json"})})
    if (!Checked)
      return Checked;
  const auto Ends = [&A](std::string_view E) { return A.Output.ends_with(E); };
  if (A.Format.Quality && !Ends(".jpg") && !Ends(".jpeg") && !Ends(".webp"))
    return Usage(
        "--quality applies to .jpg and .webp, expected -o with one of them");
  if (A.Format.Half && !Ends(".exr"))
    return Usage("--exr-half applies to .exr, expected -o with this extension");
  if (auto Checked = checkDrawOptions(O); !Checked)
    return Checked;
  if (auto Checked = checkLayers(A.Layers, O, isOne(A)); !Checked)
    return Checked;
  if (A.Overlap && O.Blending == Path::Simt)
    return Usage("--overlap runs cores and rasterizers concurrently, expected "
                 "--path raster");
  if (O.Deal == Dealing::LastFrame &&
      (O.Blending == Path::Simt || O.ZTiles != 1 || O.PixelUnit.any()))
    return Usage(
        "--deal last-frame needs tiles that a rasterizer blends with one "
        "command, expected --path raster, --ztiles 1 and --pixel-unit off");
  if (A.Overlap && isOne(A))
    return Usage("--overlap needs several pictures, expected --view all or "
                 "several --view");
  if (!isOne(A) && !A.Pairs.empty())
    return Usage("--dump-pairs applies to one picture, expected one --view");
  if (!isOne(A) && !A.Html.empty())
    return Usage("--html applies to one picture, expected one --view");
  if (!A.HeatMap.empty()) {
    if (auto Checked = checkPrefix("--heat-map", A.HeatMap); !Checked)
      return Checked;
    if (O.Blending == Path::Simt)
      return Usage(
          "--heat-map shows the work of rasterizers, expected --path raster");
    if (!isOne(A) || blendsAgain(A) || A.Explain == "measure")
      return Usage(
          "--heat-map applies to one blending pass of one view, expected one "
          "--view, and neither --depth, --normals nor --explain=measure");
  }
  if (!isOne(A) && A.Explain == "measure")
    return Usage(
        "--explain=measure applies to one picture, expected one --view");
  // A render may take minutes: find out now whether it can be kept.
  std::vector<NamedFile> Outputs = HeatMapFiles::outputs(A.HeatMap);
  Outputs.insert(Outputs.end(), {{"-o", isOne(A) ? A.Output : ""},
                                 {"--json", A.Json},
                                 {"--html", A.Html},
                                 {"--dump-pairs", A.Pairs},
                                 {"--write-cameras", A.CamerasOut}});
  const std::vector<NamedFile> Layers = A.Layers.named();
  Outputs.insert(Outputs.end(), Layers.begin(), Layers.end());
  return claimOutputs(Outputs, InputFiles()
                                   .watched()
                                   .scene(A.Scene.Path)
                                   .cameras(A.Cameras.File)
                                   .file("--technology", A.Energy.Technology)
                                   .named());
}

/// Where the rules' near plane hides more of a view than it shows.
void hintAtNear(const RenderOptions &O, const ViewFacts &F) {
  if (!O.Near && 2 * F.BeforeNear > F.InView)
    printDiagnostic(
        "splat", "note", "",
        fmt::format("{} of {} Gaussians in front of the camera are culled by "
                    "the near plane at depth {:g}: --near sets a smaller depth",
                    F.BeforeNear, F.InView, O.nearLimit()));
}

RenderPlan requestedPlan(const RenderArguments &A, const EffectInputs &In) {
  RenderPlan Plan = planRender(EffectPlan(A.Request, In), A.Options);
  warnOfMissing(Plan.Effects, A.Effects);
  if (!A.Explain.empty())
    printOut("{}", explain(Plan));
  return Plan;
}

/// Draws by run-time flags where that is faster for one frame.
void fallBack(const RenderArguments &A, const Launcher &L,
              const EffectInputs &In, RenderPlan &Plan) {
  // The counts of a frame must not depend on what was compiled before.
  const bool FiguresWanted = !A.Json.empty() || !A.Explain.empty() ||
                             !A.Numerics.empty() || !A.HeatMap.empty() ||
                             !A.Html.empty() || A.Time || A.Energy.isWanted() ||
                             A.ClockMhz.has_value();
  if (A.Request.Selection != EffectRequest::Mode::Auto || FiguresWanted)
    return;
  RenderPlan Cheaper = cheaperFirstFrame(L, Plan, In);
  if (Cheaper.Programs == Plan.Programs)
    return;
  printOut("effects: by run-time flags, because those programs are already "
           "compiled\n");
  Plan = std::move(Cheaper);
}

/// Whether the tiles of the picture are to be shown.
bool wantsTiles(const RenderArguments &A) {
  // Of a second blend, or of several pictures, the figures would be others.
  return !A.HeatMap.empty() ||
         (!A.Html.empty() && A.Options.Blending == Path::Raster &&
          !blendsAgain(A) && A.Explain != "measure");
}

/// The page of --html. \p Map may be nullptr.
Expected<Success> writeHtml(const std::string &File, const PictureJob &J,
                            const RenderResult &R,
                            nlohmann::ordered_json Report,
                            const HeatMapFiles *Map) {
  if (Map) {
    const auto Tiles = Map->tiles();
    if (!Tiles)
      return Tiles.error();
    Report["heat_map"] = heatJson(*Tiles);
  }
  auto Png = encodePng(R.Picture);
  if (!Png)
    return Png.error();
  const auto Page =
      timePageOf({{J.ScenePath, std::move(Report), std::move(*Png)}});
  return Page ? writeFileAtomically(File, *Page)
              : Expected<Success>(Page.error());
}

Expected<Success> printEnergy(const PictureJob &J,
                              const std::vector<StageReport> &Stages,
                              const std::string &What) {
  if (!J.Energy)
    return Success{};
  const auto Text = frameEnergyText(Stages, *J.Energy, What);
  if (!Text)
    return Text.error();
  printOut("{}", *Text);
  return Success{};
}

bool wantsTime(const RenderArguments &A) {
  return A.Time || A.ClockMhz || A.Energy.isWanted() || !A.Html.empty();
}

/// Where a region of launches has no more than a part of the time of \p Stages
/// that \p A asks for. Without it the page has nothing to show.
Expected<Success> checkWholeTime(const RenderArguments &A, const PictureJob &J,
                                 const std::vector<StageReport> &Stages) {
  const std::string Region = J.Launch.device().options().text("VORION_REGION");
  if (!wantsTime(A) || Region.empty() || frameTime(Stages))
    return Success{};
  const std::string What = fmt::format(
      "VORION_REGION={} times only a part of the launches", printable(Region));
  if (!A.Html.empty())
    return Error{A.Html,
                 "no page: " + What + ", expected all launches of the picture",
                 ExitCode::Usage};
  printDiagnostic("splat", "note", "",
                  What + ": there is no time or energy of a whole picture");
  return Success{};
}

/// \p Map may be nullptr.
Expected<Success> renderOne(const RenderArguments &A, const PictureJob &J,
                            const Camera &C, const HeatMapFiles *Map) {
  const auto R = drawPicture(J, C);
  clearStatus();
  if (!R) {
    showBuildLog(J.Launch);
    return R.error();
  }
  if (auto Written = writePicture(J, C, *R); !Written)
    return Written;
  printOut("{}", textReport(C, J.Options, J.Launch.device(), *R));
  if (auto Printed = printEnergy(J, R->Stages, "frame"); !Printed)
    return Printed;
  if (auto Whole = checkWholeTime(A, J, R->Stages); !Whole)
    return Whole;
  if (!Map && A.Html.empty())
    return Success{};
  auto Report = reportOf(J, J.Output, C, *R);
  if (!Report)
    return Report.error();
  if (!A.Html.empty())
    if (auto Written = writeHtml(A.Html, J, *R, *Report, Map); !Written)
      return Written;
  return Map ? Map->write(C, std::move(*Report)) : Expected<Success>(Success{});
}

/// That no picture would take the place of another or of another file.
Expected<Success> claimPictures(const RenderArguments &A,
                                const std::vector<Camera> &Cameras) {
  std::set<std::string> Files;
  std::vector<NamedFile> Pictures;
  for (const Camera &C : Cameras)
    if (const auto [File, IsNew] = Files.insert(pictureFile(A.Output, C));
        !IsNew)
      return Error{A.Cameras.File,
                   fmt::format("two of the views would be written to {}, "
                               "expected views with different names",
                               *File),
                   ExitCode::Usage};
    else
      Pictures.push_back({"the picture of view " + printable(C.Name), *File});
  return claimOutputs(Pictures, InputFiles()
                                    .scene(A.Scene.Path)
                                    .cameras(A.Cameras.File)
                                    .file("--write-cameras", A.CamerasOut)
                                    .file("--json", A.Json)
                                    .named());
}

Expected<Success> renderAll(const RenderArguments &A, const PictureJob &J,
                            const std::vector<Camera> &Cameras) {
  const auto R = renderSequence(J.Launch, J.Plan, J.Input.Gaussians, Cameras,
                                J.Options, A.Overlap);
  clearStatus();
  if (!R) {
    showBuildLog(J.Launch);
    return R.error();
  }
  if (auto Written = writePictures(
          J, Cameras, A.Overlap, *R,
          [](const std::string &File) { printOut("{}\n", escaped(File)); });
      !Written)
    return Written;
  printOut("{}", sequenceText(*R));
  if (auto Whole = checkWholeTime(A, J, R->Stages); !Whole)
    return Whole;
  return printEnergy(J, R->Stages, "all");
}

Expected<Success> run(RenderArguments &A, DeviceOptions Machine) {
  if (auto Checked = check(A); !Checked)
    return Checked.error();
  const auto Energy = requestedEnergy(A.Energy, A.ClockMhz);
  if (!Energy)
    return Energy.error();
  const auto File = loadScene(A.Scene, loadPlatforms);
  if (!File)
    return File.error();
  drawAs(A.Options, File->DrawnAs);
  const Scene *S = &File->Gaussians;
  const auto Cameras = chooseCameras(A.Cameras, *S);
  if (!Cameras)
    return Cameras.error();
  if (auto Through = drawThrough(A.Options, A.Cameras.File, *Cameras); !Through)
    return Through;
  if (!isOne(A))
    if (auto Checked = claimPictures(A, *Cameras); !Checked)
      return Checked;
  if (!A.CamerasOut.empty())
    if (auto Written = writeCameras(A.CamerasOut, *Cameras); !Written)
      return Written;
  if (wantsTime(A))
    turnClockOn(Machine, A.ClockMhz,
                A.Time                ? "--time"
                : A.Energy.isWanted() ? "--energy"
                                      : "--html");
  std::optional<NumericsReport> Numerics;
  if (!A.Numerics.empty()) {
    auto Begun = NumericsReport::begin(A.Numerics, Machine);
    if (!Begun)
      return Begun.error();
    Numerics.emplace(std::move(*Begun));
  }
  std::optional<HeatMapFiles> Map;
  if (wantsTiles(A)) {
    auto Begun = HeatMapFiles::begin(A.HeatMap, Machine);
    if (!Begun)
      return Begun.error();
    Map.emplace(std::move(*Begun));
  }
  const ViewFacts Facts = factsOfAll(*S, *Cameras, A.Options);
  hintAtNear(A.Options, Facts);
  const EffectInputs Inputs{*S,
                            A.Options,
                            Facts,
                            !A.Pairs.empty(),
                            A.Layers.needDepths(),
                            Machine,
                            A.Layers.needNormals(),
                            A.Layers.needLists(),
                            Cameras->size()};
  RenderPlan Plan = requestedPlan(A, Inputs);
  if (Map && Plan.Effects.done(effects::Windows)) {
    if (!A.HeatMap.empty())
      return Error{
          "",
          "--heat-map needs one tile grid for the picture, which a picture in "
          "windows does not have: expected a narrower picture",
          ExitCode::Usage};
    Map.reset();
  }

  const auto Open = [&] {
    auto Opened = openDevice(A.Device, A.Options.Blending, Machine);
    if (Opened)
      checkEnergyOf(*Opened, *Energy);
    return Opened;
  };
  std::string Measured;
  if (A.Explain == "measure") {
    const auto Costs = measureEffects(Open, A.KernelFolder, A.Request, Inputs,
                                      Cameras->front(), progress());
    clearStatus();
    if (!Costs)
      return Costs.error();
    Measured = toString(*Costs);
  }
  auto D = Open();
  if (!D)
    return D.error();
  Launcher L(*D, A.KernelFolder, progressOf(Cameras->size()));
  fallBack(A, L, Inputs, Plan);
  const PictureJob J{A.Scene.Path,
                     A.Scene.Axes,
                     A.Cameras.File,
                     *File,
                     A.Options,
                     Plan,
                     L,
                     A.Output,
                     A.Json,
                     A.Pairs,
                     A.Layers,
                     A.Format,
                     *Energy};
  auto Rendered = isOne(A)
                      ? renderOne(A, J, Cameras->front(), Map ? &*Map : nullptr)
                      : renderAll(A, J, *Cameras);
  if (!Rendered)
    return Rendered;
  L.recordBuilds();
  if (Numerics) {
    const auto Text = Numerics->text();
    if (!Text)
      return Text.error();
    printOut("{}", *Text);
  }
  printOut("{}", Measured);
  return Success{};
}

} // namespace

Runner addRender(CLI::App &App) {
  auto A = std::make_shared<RenderArguments>();
  addSceneOptions(App, A->Scene);
  addCameraOptions(App, A->Cameras, /*Several=*/true);
  takesView(
      App.add_option("--view", A->Cameras.Views,
                     "Name or number of a view (default: the first); may be "
                     "repeated, or \"all\". The files of several pictures have "
                     "the view's name before the extension"),
      {"all"})
      ->allow_extra_args(false);
  writesFile(App.add_option("--write-cameras", A->CamerasOut,
                            "Write the rendered views as cameras.json"),
             {".json"});
  App.add_flag("--overlap", A->Overlap,
               "With several pictures, overlap the preparation of one with the "
               "blending of another");
  addChoice(App, "--deal", A->Options.Deal,
            {Dealing::Lists, Dealing::LastFrame},
            "Distribution of tiles to the rasterizers: by the lengths of their "
            "lists or, with several pictures, by their cost in the previous "
            "one (docs/ideas.md)");
  writesFile(App.add_option("-o,--output", A->Output,
                            "Picture file: .png, .jpg or .webp with 8 bits, or "
                            ".exr, .pfm or .npz with floats (default: the "
                            "scene's name with .png, in the current folder)"),
             {pictureEndings().begin(), pictureEndings().end()});
  App.add_option(
         "--quality", A->Format.Quality,
         "Quality of a .jpg (default 95) or a lossy .webp (default: lossless)")
      ->check(isBetween(1, 100));
  App.add_flag("--exr-half", A->Format.Half,
               "Write .exr with 16-bit floats (default: 32-bit)");
  writesFile(App.add_option("--json", A->Json,
                            "Write a report with options, counters and times"),
             {".json"});
  writesFile(
      App.add_option(
          "--html", A->Html,
          "Write a page with the breakdown of the frame time (implies --time)"),
      {".html"});
  addDrawOptions(App, *A);
  addDeviceOption(App, A->Device);
  App.add_flag(
         "--explain{plan}", A->Explain,
         "Report for each effect whether it is compiled in, and why; with "
         "=measure, also measure its cost by rendering with and without it")
      ->option_text("[=measure]")
      ->check(isOneOf({"plan", "measure"}));
  App.add_flag("--time", A->Time,
               "Report the modelled frame time (docs/model.md)");
  App.add_option("--clock", A->ClockMhz,
                 "Clock frequency of the timing model (implies --time; "
                 "default: the machine's, 530)")
      ->option_text("MHZ")
      ->check(isBetween(1U, MostClockMhz));
  addEnergyOptions(App, A->Energy, "the frame");
  App.add_flag("--numerics{on}", A->Numerics,
               "Report where fp32 results deviate from double precision, by "
               "source line and rasterizer stage (docs/debugging.md)")
      ->option_text("[=SETTING,...]");
  writesFiles(
      App.add_option("--heat-map", A->HeatMap,
                     "Write maps of the rasterizers' work per tile: "
                     "PREFIX.list.png, .blends, .cycles and .saturation, and "
                     "PREFIX.json (docs/debugging.md)"));
  addLayerOptions(App, A->Layers);
  writesFile(App.add_option(
                 "--dump-pairs", A->Pairs,
                 "Write the sorted tile, depth_bits and index arrays (.npz)"),
             {".npz"});
  addKernelsOption(App, A->KernelFolder);
  return [A](const DeviceOptions &Machine) {
    const bool IsNamed = !A->Output.empty();
    nameOutput("-o", A->Output, A->Scene.Path, ".png");
    if (auto Parsed = parseDrawTexts(*A); !Parsed)
      return Parsed;
    auto Drawn = run(*A, Machine);
    if (Drawn && !IsNamed && isOne(*A))
      printOut("picture    {}\n", escaped(A->Output));
    return Drawn;
  };
}

} // namespace vorion::splat
