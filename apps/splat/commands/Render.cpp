#include "commands/CameraArguments.h"
#include "commands/Choices.h"
#include "commands/Commands.h"
#include "commands/DeviceArguments.h"
#include "commands/EnergyArguments.h"
#include "commands/HeatMapFiles.h"
#include "commands/InputFiles.h"
#include "commands/LayerOptions.h"
#include "commands/MeshArguments.h"
#include "commands/NumericsReport.h"
#include "commands/OutputFile.h"
#include "commands/PictureOptions.h"
#include "commands/Progress.h"
#include "commands/SceneArguments.h"
#include "effects/Registry.h"

#include "io/Cameras.h"
#include "io/Npz.h"
#include "mesh/Mesh.h"
#include "page/TimePage.h"
#include "picture/HeatMap.h"
#include "picture/View.h"
#include "poses/Video.h"
#include "render/EffectCosts.h"
#include "render/Explain.h"
#include "render/Fallback.h"
#include "render/FrameTime.h"
#include "render/MeshRules.h"
#include "render/Pictures.h"
#include "render/Report.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"
#include "vorion/support/StatusLine.h"
#include "vorion/support/TemporaryFolder.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
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
  std::string Json, Pairs, Device, KernelFolder;
  PageFiles Page;
  std::vector<std::string> WhatIf;
  LayerFiles Layers;
  bool Explain = false;
  bool Time = false, Overlap = false;
  std::optional<unsigned> ClockMhz;
  EnergyArguments Energy;
  PictureFormat Format;
  std::optional<double> FrameRate; ///< of a video, per second
  std::string Numerics;            ///< settings, empty for no
  std::string HeatMap; ///< what names of files begin with, empty for no
  MeshArguments Mesh;
  std::string Visible; ///< --visible
};

bool isOne(const RenderArguments &A) { return A.Cameras.isOne(); }

bool isVideo(const RenderArguments &A) { return isVideoName(A.Output); }

bool wantsTime(const RenderArguments &A) {
  return A.Time || A.ClockMhz || A.Energy.isWanted() || A.Page.any() ||
         !A.WhatIf.empty();
}

/// Whether the device blends the lists more than once.
bool blendsAgain(const RenderArguments &A) {
  return A.Layers.needDepths() || A.Layers.needNormals();
}

/// What a mesh, if there is one, cannot be drawn with; and what needs one.
Expected<Success> checkMesh(const RenderArguments &A, bool HasMesh) {
  const auto Usage = [](std::string What) {
    return Error{"", std::move(What), ExitCode::Usage};
  };
  if (!HasMesh) {
    if (!A.Visible.empty())
      return Usage("--visible shows a mesh, expected --mesh");
    return A.Mesh.Light ? lightWithoutMesh() : Expected<Success>(Success{});
  }
  if (A.Layers.needNormals() || A.Layers.needLists())
    return layersBesideMesh();
  if (!A.HeatMap.empty())
    return Usage("--heat-map shows one command per tile, expected no --mesh");
  if (!isOne(A) && !A.Visible.empty())
    return Usage("--visible applies to one picture, expected one --view");
  return Success{};
}

/// A mirror and traced rays need each other wherever there is a mesh.
Expected<Success> checkMirror(const RenderArguments &A) {
  const auto Usage = [](std::string What) {
    return Error{"", std::move(What), ExitCode::Usage};
  };
  const RenderOptions &O = A.Options;
  if (O.IsMirror && !O.Surface)
    return Usage("--material mirror is of a mesh, expected --mesh");
  if (O.IsMirror && O.Kind != RendererKind::Trace)
    return Usage("--material mirror needs traced rays, expected --renderer "
                 "trace --path simt");
  if (!O.Surface || O.Kind != RendererKind::Trace)
    return Success{};
  if (!O.IsMirror)
    return Usage("--renderer trace draws a mesh as a mirror only, expected "
                 "--material mirror, or --renderer splat");
  if (A.Mesh.Light)
    return Usage("--light does not shine on a mirror, expected no --light");
  if (!A.Visible.empty())
    return excludedByRays("--visible", RendererKind::Trace);
  if (O.Surface->has(AlphaMode::Mask) || O.Surface->has(AlphaMode::Blend))
    return Error{O.Surface->file(),
                 "has transparent surfaces, expected opaque ones of a mirror"};
  return Success{};
}

/// What a video cannot be written with.
Expected<Success> checkVideo(const RenderArguments &A) {
  const auto Usage = [](std::string What) {
    return Error{"", std::move(What), ExitCode::Usage};
  };
  if (!isVideo(A))
    return A.FrameRate ? Usage("--frame-rate is of a video, expected -o with "
                               ".mp4 or .webm")
                       : Expected<Success>(Success{});
  if (isOne(A))
    return Usage("-o: a video has several pictures, expected --orbit, "
                 "--frames or --view all");
  if (!A.Json.empty() || wantsTime(A))
    return Usage("reports and times are of pictures, expected -o with a "
                 "picture, or none of --json, --time, --clock and --energy");
  return checkVideoWriter();
}

/// Refuses options that only footprints have.
Expected<Success> checkRenderer(const RenderArguments &A) {
  const RendererKind Kind = A.Options.Kind;
  const bool IsRays = Kind != RendererKind::Splat;
  const bool IsTrace = Kind == RendererKind::Trace;
  for (const auto &[Is, Option] :
       {std::pair{IsRays && !A.Numerics.empty(), "--numerics"},
        {IsTrace && A.Layers.needLists(),
         "--contributors or --depth-as median"},
        {IsTrace && A.Layers.needDepths(), "--depth"},
        {IsTrace && A.Layers.needNormals(), "--normals"},
        {IsTrace && !A.Pairs.empty(), "--pairs"}})
    if (Is)
      return excludedByRays(Option, Kind);
  return checkRenderer(A.Options, A.Scene.Options.Drawn);
}

/// The extensions of -o.
std::vector<std::string_view> outputEndings() {
  std::vector<std::string_view> Endings(pictureEndings().begin(),
                                        pictureEndings().end());
  Endings.insert(Endings.end(), std::begin(VideoEndings),
                 std::end(VideoEndings));
  return Endings;
}

/// What can be said to be wrong before anything is read.
Expected<Success> check(const RenderArguments &A) {
  const auto Usage = [](std::string What) {
    return Error{"", std::move(What), ExitCode::Usage};
  };
  const RenderOptions &O = A.Options;
  for (const auto &Checked :
       {checkRenderer(A), checkEnding("-o", A.Output, outputEndings()),
        checkVideo(A), checkEnding("--pairs", A.Pairs, {".npz"}),
        checkEnding("--visible", A.Visible, {".npz"}),
        A.Mesh.File.empty() ? Success{} : checkMesh(A, /*HasMesh=*/true),
        checkJsonName(A.Json), checkPage(A.Page),
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
    return Usage("--pairs applies to one picture, expected one --view");
  if (!isOne(A) && A.Page.any())
    return Usage(A.Page.Html.empty()
                     ? "--figures applies to one picture, expected one --view"
                     : "--html applies to one picture, expected one --view");
  if (!isOne(A) && !A.WhatIf.empty())
    return Usage("--what-if applies to one picture, expected one --view");
  if (!A.HeatMap.empty()) {
    if (auto Checked = checkPrefix("--heat-map", A.HeatMap); !Checked)
      return Checked;
    if (O.Blending == Path::Simt)
      return Usage(
          "--heat-map shows the work of rasterizers, expected --path raster");
    if (!isOne(A) || blendsAgain(A))
      return Usage(
          "--heat-map applies to one blending pass of one view, expected one "
          "--view, and neither --depth nor --normals");
  }
  // A render may take minutes: find out now whether it can be kept.
  std::vector<NamedFile> Outputs = HeatMapFiles::outputs(A.HeatMap);
  Outputs.insert(Outputs.end(), {{"-o", isOne(A) || isVideo(A) ? A.Output : ""},
                                 {"--json", A.Json},
                                 {"--html", A.Page.Html},
                                 {"--pairs", A.Pairs},
                                 {"--visible", A.Visible},
                                 {"--write-cameras", A.CamerasOut}});
  const std::vector<NamedFile> Layers = A.Layers.named();
  Outputs.insert(Outputs.end(), Layers.begin(), Layers.end());
  return claimOutputs(Outputs, InputFiles()
                                   .watched()
                                   .scene(A.Scene.Path)
                                   .cameras(A.Cameras.File)
                                   .file("--technology", A.Energy.Technology)
                                   .file("--mesh", A.Mesh.File)
                                   .named());
}

RenderPlan requestedPlan(const RenderArguments &A, const EffectInputs &In) {
  RenderPlan Plan = planRender(EffectPlan(A.Request, In), A.Options);
  warnOfMissing(Plan.Effects, A.Effects);
  if (A.Explain)
    printOut("{}", explain(Plan));
  return Plan;
}

/// Draws by run-time flags where that is faster for one frame.
void fallBack(const RenderArguments &A, const Launcher &L,
              const EffectInputs &In, RenderPlan &Plan) {
  // The counts of a frame must not depend on what was compiled before.
  const bool FiguresWanted = !A.Json.empty() || A.Explain ||
                             !A.Numerics.empty() || !A.HeatMap.empty() ||
                             wantsTime(A);
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
         (A.Page.any() && A.Options.Blending == Path::Raster &&
          !A.Options.Surface && !blendsAgain(A));
}

/// The page of --html and its figures. \p Map may be nullptr.
Expected<Success> writeTimes(const PageFiles &To, const PictureJob &J,
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
  return Page ? writePage(To, *Page) : Expected<Success>(Page.error());
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

/// Where a region of launches has no more than a part of the time of \p Stages
/// that \p A asks for. Without it the page has nothing to show.
Expected<Success> checkWholeTime(const RenderArguments &A, const PictureJob &J,
                                 const std::vector<StageReport> &Stages) {
  const std::string Region = J.Launch.device().options().text("VORION_REGION");
  if (!wantsTime(A) || Region.empty() || frameTime(Stages))
    return Success{};
  const std::string What = fmt::format(
      "VORION_REGION={} times only a part of the launches", printable(Region));
  if (A.Page.any())
    return Error{A.Page.Html,
                 "no page: " + What + ", expected all launches of the picture",
                 ExitCode::Usage};
  printDiagnostic("splat", "note", "",
                  What + ": there is no time or energy of a whole picture");
  return Success{};
}

Expected<Success> writeVisible(const std::string &File, const VisibleMesh &V) {
  const std::vector<std::size_t> Shape{static_cast<std::size_t>(V.Height),
                                       static_cast<std::size_t>(V.Width)};
  Npz Arrays{{"depth", NpyArray::of(Shape, V.Depth)},
             {"triangle", NpyArray::of(Shape, V.Triangles)}};
  if (const std::size_t Layers = V.LayerDepths.size() / V.Depth.size();
      Layers != 0) {
    const std::vector<std::size_t> Planes{Layers, Shape[0], Shape[1]};
    Arrays["layer_depth"] = NpyArray::of(Planes, V.LayerDepths);
    Arrays["layer_triangle"] = NpyArray::of(Planes, V.LayerTriangles);
  }
  return writeNpz(File, Arrays);
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
  if (!A.Visible.empty())
    if (auto Written = writeVisible(A.Visible, *R->MeshShown); !Written)
      return Written;
  printOut("{}",
           boundsText(frameJson(R->Stages), J.Others, pictureHash(R->Picture)));
  printOut("{}", textReport(C, J.Options, J.Launch.device(), *R));
  if (auto Printed = printEnergy(J, R->Stages, "frame"); !Printed)
    return Printed;
  if (auto Whole = checkWholeTime(A, J, R->Stages); !Whole)
    return Whole;
  if (!Map && !A.Page.any())
    return Success{};
  auto Report = reportOf(J, J.Output, C, *R);
  if (!Report)
    return Report.error();
  if (A.Page.any())
    if (auto Written = writeTimes(A.Page, J, *R, *Report, Map); !Written)
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
                                    .file("--mesh", A.Mesh.File)
                                    .named());
}

Expected<Success> renderAll(const RenderArguments &A, const PictureJob &J,
                            const std::vector<Camera> &Cameras) {
  const auto R = renderSequence(J.Launch, J.Plan, std::move(J.Input.Gaussians),
                                Cameras, J.Options, A.Overlap);
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
  printOut("{}{}", boundsText(sequenceJson(*R), {}, ""), sequenceText(*R));
  if (auto Whole = checkWholeTime(A, J, R->Stages); !Whole)
    return Whole;
  return printEnergy(J, R->Stages, "all");
}

/// Renders \p Cameras a few at a time, and joins the pictures to a video.
Expected<Success> renderVideo(const RenderArguments &A, const PictureJob &J,
                              const std::vector<Camera> &Cameras) {
  const auto Folder = TemporaryFolder::make("splat-frames");
  if (!Folder)
    return Folder.error();
  constexpr std::size_t AtOnce = 16; // pictures in memory
  std::size_t Count = 0;
  for (std::size_t I = 0; I < Cameras.size(); I += AtOnce) {
    const std::vector<Camera> Part(
        Cameras.begin() + static_cast<std::ptrdiff_t>(I),
        Cameras.begin() +
            static_cast<std::ptrdiff_t>(std::min(I + AtOnce, Cameras.size())));
    const auto R = renderSequence(J.Launch, J.Plan, J.Input.Gaussians, Part,
                                  J.Options, A.Overlap);
    if (!R) {
      clearStatus();
      showBuildLog(J.Launch);
      return R.error();
    }
    for (const RenderResult &Frame : R->Frames)
      if (auto Written =
              writeImage(fmt::format("{}/{:06}.png", Folder->path(), Count++),
                         Frame.Picture, J.Format);
          !Written)
        return Written;
  }
  constexpr double DefaultRate = 30;
  const double Rate = A.FrameRate.value_or(DefaultRate);
  clearStatus();
  if (auto Written = writeVideo(A.Output, Folder->path() + "/", Rate); !Written)
    return Written;
  printOut("{}: {} of {}x{}, {:g} a second\n", escaped(A.Output),
           counted(Count, "picture"), Cameras.front().Width,
           Cameras.front().Height, Rate);
  return Success{};
}

Expected<Success> run(RenderArguments &A, DeviceOptions Machine) {
  if (auto Checked = check(A); !Checked)
    return Checked.error();
  const auto Energy = requestedEnergy(A.Energy, A.ClockMhz);
  if (!Energy)
    return Energy.error();
  auto File = loadScene(A.Scene, loadPlatforms);
  if (!File)
    return File.error();
  const auto OwnMesh = loadOwnMesh(A.Scene, *File);
  if (!OwnMesh)
    return OwnMesh.error();
  const auto AddedMesh = loadAddedMesh(A.Mesh);
  if (!AddedMesh)
    return AddedMesh.error();
  A.Options.Light = A.Mesh.Light;
  A.Options.KeepVisible = !A.Visible.empty();
  drawByFile(A.Options, File->DrawnAs, File->Gaussians);
  for (const auto &Checked :
       {checkRenderer(A),
        checkFalloff(A.Options.Kind, A.Scene.Options.Drawn.FalloffDegree)})
    if (!Checked)
      return Checked;
  const Scene *S = &File->Gaussians;
  const auto Cameras =
      camerasToDraw(A.Cameras, *File, A.Options.Convention, A.Options.Near);
  if (!Cameras)
    return Cameras.error();
  if (auto Through = drawThrough(A.Options, A.Cameras.File, *Cameras); !Through)
    return Through;
  if (auto Checked = checkRays(A.Options, A.Cameras.File); !Checked)
    return Checked;
  if (A.Options.Kind != RendererKind::Splat && !File->DrawnAs.Source.empty())
    printDiagnostic("splat", "note", A.Scene.Path,
                    fmt::format("is not drawn as \"{}\" says, which is of "
                                "footprints: --renderer splat does",
                                printable(File->DrawnAs.Source)));
  // In the frame of the scene as it is drawn.
  A.Options.Surface = joined(*OwnMesh, *AddedMesh, S->Origin);
  for (const auto &Checked :
       {checkMesh(A, A.Options.Surface != nullptr), checkMirror(A),
        checkTransparency(A.Options, A.Layers.needDepths(), A.Overlap),
        checkMeshCamera(A.Options, A.Cameras.File),
        checkMeshPrecision(A.Options, A.Cameras.File)})
    if (!Checked)
      return Checked;
  if (!isOne(A) && !isVideo(A))
    if (auto Checked = claimPictures(A, *Cameras); !Checked)
      return Checked;
  if (!A.CamerasOut.empty())
    if (auto Written = writeCameras(A.CamerasOut, *Cameras); !Written)
      return Written;
  if (wantsTime(A))
    turnClockOn(Machine, A.ClockMhz,
                A.Time                ? "--time"
                : A.Energy.isWanted() ? "--energy"
                : !A.WhatIf.empty()   ? "--what-if"
                : A.Page.Html.empty() ? "--figures"
                                      : "--html");
  // What watches the picture does not watch others.
  const DeviceOptions Plain = Machine;
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
  const auto Others = measureWhatIf(
      A.WhatIf,
      [&](const std::string &Settings) -> DeviceOpener {
        DeviceOptions With = Plain;
        const std::string Set = With.text("VORION_SET");
        With.set("VORION_SET", Set.empty() ? Settings : Set + "," + Settings,
                 "--what-if");
        return [&A, With] {
          return openDevice(A.Device, A.Options.Blending, With);
        };
      },
      A.KernelFolder, Plan, Inputs, Cameras->front(), progress());
  clearStatus();
  if (!Others)
    return Others.error();
  auto D = Open();
  if (!D)
    return D.error();
  Launcher L(*D, A.KernelFolder, progressOf(Cameras->size()));
  fallBack(A, L, Inputs, Plan);
  const PictureJob J{A.Scene.Path, A.Scene.Axes, A.Cameras.File, *File,
                     S->size(),    A.Options,    Plan,           L,
                     A.Output,     A.Json,       A.Pairs,        A.Layers,
                     A.Format,     *Energy,      *Others};
  auto Rendered = isOne(A)
                      ? renderOne(A, J, Cameras->front(), Map ? &*Map : nullptr)
                  : isVideo(A) ? renderVideo(A, J, *Cameras)
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
  return Success{};
}

} // namespace

Runner addRender(CLI::App &App) {
  auto A = std::make_shared<RenderArguments>();
  A->Scene.KeepsMeshes = true;
  addSceneOptions(App, A->Scene);
  addCameraOptions(App, A->Cameras, /*Several=*/true);
  HelpGroup Group(App, "Cameras");
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
  Group.next("Output");
  writesFile(App.add_option("-o,--output", A->Output,
                            "Picture file: .png, .jpg or .webp with 8 bits, or "
                            ".exr, .pfm or .npz with floats (default: the "
                            "scene's name with .png, in the current folder); "
                            "or a video of several views: .mp4 or .webm"),
             [] {
               const auto Endings = outputEndings();
               return std::vector<std::string>(Endings.begin(), Endings.end());
             }());
  App.add_option("--frame-rate", A->FrameRate,
                 "Pictures per second of a video (default 30)")
      ->check(isBetween(0.1, 240.0));
  App.add_option(
         "--quality", A->Format.Quality,
         "Quality of a .jpg (default 95) or a lossy .webp (default: lossless)")
      ->check(isBetween(1, 100));
  App.add_flag("--exr-half", A->Format.Half,
               "Write .exr with 16-bit floats (default: 32-bit)");
  writesFile(App.add_option("--json", A->Json,
                            "Write a report with options, counters and times"),
             {".json"});
  addPageOptions(
      App, A->Page,
      "Write a page with the breakdown of the frame time (implies --time)");
  addDrawOptions(App, *A);
  Group.next("Picture");
  addRendererOption(App, A->Options.Kind, A->Scene.Options.Drawn,
                    {RendererKind::Splat, RendererKind::Ray,
                     RendererKind::Surfel, RendererKind::Trace});
  Group.next("Accuracy and speed");
  App.add_flag("--overlap", A->Overlap,
               "With several pictures, overlap the preparation of one with the "
               "blending of another");
  addChoice(App, "--ray-restart", A->Options.Restart,
            {RayRestart::Root, RayRestart::Checkpoint},
            "Where the next pass of a ray of --renderer trace begins: at the "
            "tree's root, or where the one before left something; results are "
            "bit-identical");
  addChoice(App, "--deal", A->Options.Deal,
            {Dealing::Lists, Dealing::LastFrame},
            "Distribution of tiles to the rasterizers: by the lengths of their "
            "lists or, with several pictures, by their cost in the previous "
            "one (docs/ideas.md)");
  addMeshOptions(App, A->Mesh);
  Group.next("Scene");
  App.add_option_function<std::string>(
         "--material",
         [A](const std::string & /*Name*/) { A->Options.IsMirror = true; },
         "Material of all meshes, with --renderer trace: mirror "
         "(docs/meshes.md)")
      ->check(CLI::IsMember({"mirror"}));
  addMeshPrecisionOptions(App, A->Options);
  Group.next("Beside the picture");
  writesFile(App.add_option("--visible", A->Visible,
                            "Write depth and triangle of the mesh in each "
                            "pixel (.npz)"),
             {".npz"});
  Group.next("Analysis");
  addDeviceOption(App, A->Device);
  App.add_flag("--explain", A->Explain,
               "Report for each effect whether it is compiled in, and why");
  Group.next("Time and energy");
  App.add_flag("--time", A->Time,
               "Report the modelled frame time (docs/model.md)");
  App.add_option("--clock", A->ClockMhz,
                 "Clock frequency of the timing model (implies --time; "
                 "default: the machine's, 530)")
      ->option_text("MHZ")
      ->check(isBetween(1U, MostClockMhz));
  App.add_option("--what-if", A->WhatIf,
                 "Measure the frame with these keys of --set, too (implies "
                 "--time); may be repeated")
      ->allow_extra_args(false)
      ->option_text("KEY=VALUE,...");
  addEnergyOptions(App, A->Energy, "the frame");
  Group.next("Analysis");
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
  Group.next("Beside the picture");
  writesFile(App.add_option(
                 "--pairs", A->Pairs,
                 "Write the sorted tile, depth_bits and index arrays (.npz)"),
             {".npz"});
  addKernelsOption(App, A->KernelFolder);
  return [A](const DeviceOptions &Machine) {
    const bool IsNamed = !A->Output.empty();
    nameOutput("-o", A->Output, A->Scene.Path, ".png");
    if (isVideo(*A) && A->Cameras.Views.empty())
      A->Cameras.Views = {"all"};
    if (auto Parsed = parseDrawTexts(*A); !Parsed)
      return Parsed;
    auto Drawn = run(*A, Machine);
    if (Drawn && !IsNamed && isOne(*A))
      printOut("picture    {}\n", escaped(A->Output));
    return Drawn;
  };
}

} // namespace vorion::splat
