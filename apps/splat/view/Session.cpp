#include "view/Session.h"

#include "cameras/GoodView.h"
#include "device/ClockedMachine.h"
#include "effects/Registry.h"
#include "io/CameraLens.h"
#include "io/Metrics.h"
#include "mesh/Mesh.h"
#include "picture/SceneUnit.h"
#include "render/Explain.h"
#include "render/Pictures.h"
#include "scene/SceneWriter.h"
#include "scene/Statistics.h"
#include "view/Paint.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>
#include <utility>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// Pictures that are kept: two settings of one view with and without what takes
/// longer.
constexpr std::size_t MostKept = 4;

/// Which bands of spherical harmonics are on the device.
std::array<bool, MaxShDegree> bandsOf(const EffectPlan &Plan) {
  return {Plan.done(effects::Sh1), Plan.done(effects::Sh2),
          Plan.done(effects::Sh3)};
}

Json effectsOf(const EffectPlan &Plan) {
  Json All = effectsJson(Plan);
  for (Json &One : All)
    One["what"] = effects::find(One.at("name").get<std::string>())->What;
  return All;
}

/// Of the written format that has triangles.
constexpr std::string_view MeshEnding = ".glb";

/// The triangle \p T with its place in the file and the world.
Json triangleOf(const PixelTriangle &T, const ShownScene &S) {
  const Mesh &M = *S.Surface;
  const MeshPart &Part = M.partOf(T.Triangle);
  Json Corners = Json::array();
  for (std::size_t K = 0; K < 3; ++K) {
    std::array<double, 3> World = S.File.Gaussians.Origin;
    for (std::size_t A = 0; A < 3; ++A)
      World[A] += M.Positions[3 * M.Corners[3 * T.Triangle + K] + A];
    Corners.push_back(World);
  }
  return {{"file", std::filesystem::path(Part.File).filename().string()},
          {"part", Part.Name},
          {"number", Part.Number + T.Triangle - Part.First},
          {"in_front", T.InFront},
          {"weight", T.Weight},
          {"alpha", T.Alpha},
          {"depth", T.Depth},
          {"color", T.Color},
          {"corners", Corners}};
}

/// The mesh of the file \p Path, which a page sent as \p Name, and which is
/// removed on an error.
Expected<std::shared_ptr<const Mesh>> readSent(const std::string &Path,
                                               const std::string &Name) {
  // Nobody else knows the file by its path.
  const auto ByName = [&](const std::string &Where) {
    return Where.starts_with(Path) ? Name + Where.substr(Path.size()) : Where;
  };
  auto Read = readMesh(Path);
  if (!Read) {
    std::error_code Ignored;
    std::filesystem::remove(Path, Ignored);
    return Error{ByName(Read.error().Where), Read.error().What,
                 Read.error().Code};
  }
  for (MeshWarning &W : Read->Warnings)
    W.Where = ByName(W.Where);
  for (MeshPart &Part : Read->Parts)
    Part.File = Name;
  return std::make_shared<const Mesh>(std::move(*Read));
}

/// What the device did for a picture, on this computer.
Json factsOf(const DrawnView &D) {
  Json Stages = Json::array();
  double Seconds = 0;
  for (const StageReport &S : D.Result.Stages) {
    Stages.push_back({{"name", name(S.Kind)}, {"seconds", S.Seconds}});
    Seconds += S.Seconds;
  }
  return {{"width", D.Result.Picture.Width},
          {"height", D.Result.Picture.Height},
          {"visible", D.Result.Visible},
          {"pairs", D.Result.Pairs},
          {"device_bytes", D.Result.DeviceBytes},
          {"seconds", Seconds},
          {"stages", std::move(Stages)},
          {"effects", D.Effects}};
}

/// What \p T adds: the time on the machine.
Json timeOf(const MachineTime &T) {
  Json Stages = Json::object();
  for (const auto &[Name, Cycles] : T.Stages)
    Stages[Name] = Cycles;
  return {{ClockedMachineKey, T.On},
          {"cycles", T.Cycles},
          {"machine_ms", T.Milliseconds},
          {"stage_cycles", std::move(Stages)}};
}

/// The point of the scene that the pixel of \p R shows, by the mean of its
/// depths: \p Sum of depths by weights, over that of the weights. Null where
/// nothing is.
Json pointOf(double Sum, double Weights, const ViewRequest &R) {
  const Camera &C = R.View;
  const double U = (R.X + 0.5 - C.Cx) / C.Fx, V = (R.Y + 0.5 - C.Cy) / C.Fy;
  const LensModel &Lens = *C.Optics.Model;
  const auto Ray =
      Lens.IsParallel ? Direction{0, 0, 1} : C.Optics.direction(U, V);
  constexpr double LeastWeight = 1.0 / 255;
  if (!Ray || Weights < LeastWeight)
    return nullptr;
  const double Depth = Sum / Weights;
  const double Along = Lens.byDistance() ? Depth : Depth / (*Ray)[2];
  const Vector Start = Lens.IsParallel ? Vector{U, V, 0} : Vector{};
  Vector Point = C.Position;
  for (std::size_t Row = 0; Row != 3; ++Row)
    for (std::size_t K = 0; K != 3; ++K)
      Point[Row] += C.Rotation[Row][K] * (Start[K] + Along * (*Ray)[K]);
  return Point;
}

/// \p Word as a shell has it.
std::string shellWord(const std::string &Word) {
  const bool IsPlain =
      !Word.empty() && std::ranges::all_of(Word, [](unsigned char C) {
        return std::isalnum(C) != 0 ||
               std::string_view("-_./:,=+@").find(static_cast<char>(C)) !=
                   std::string_view::npos;
      });
  if (IsPlain)
    return Word;
  std::string Quoted = "'";
  for (const char C : Word)
    Quoted += C == '\'' ? "'\\''" : std::string(1, C);
  return Quoted + "'";
}

/// The figures of \p Picture beside \p Reference.
Json errorOf(const Image &Picture, const std::vector<double> &Reference) {
  const std::vector<double> Ours(Picture.Render.begin(), Picture.Render.end());
  const Difference Off = compare(Ours, Reference, 3);
  return {{"psnr_db", Off.PsnrDb},
          {"max_abs", Off.MaxAbs},
          {"off_share", Off.OffShare}};
}

/// Of `splat render`, for the same device and kernels.
std::vector<std::string> deviceWords(const Session::Setup &S) {
  std::vector<std::string> Words;
  if (!S.Device.empty())
    Words.insert(Words.end(), {"--device", S.Device});
  if (!S.Kernels.empty())
    Words.insert(Words.end(), {"--kernels", S.Kernels});
  return Words;
}

/// The mesh in the pixels of \p R; null without one.
const VisibleMesh *seenIn(const RenderResult &R) {
  return R.MeshShown ? &*R.MeshShown : nullptr;
}

bool isSameView(const ViewRequest &A, const ViewRequest &B) {
  return A.View == B.View && A.Chosen == B.Chosen;
}

} // namespace

Session::Session(Setup S, Device D, TemporaryFolder F)
    : Settings(std::move(S)), Dev(std::move(D)),
      Clock(std::move(F), deviceWords(Settings), Settings.Machine) {}

Expected<std::unique_ptr<Session>> Session::open(Setup S, ShownScene First) {
  auto Folder = TemporaryFolder::make("splat-view");
  if (!Folder)
    return Folder.error();
  auto Dev = Device::open(S.Device, S.Machine);
  if (!Dev)
    return Dev.error();
  if (!Dev->isVorion())
    return Error{"",
                 fmt::format("{} has no rasterizer, expected a Vorion device "
                             "{}",
                             Dev->name(), SeeDoctor),
                 ExitCode::Usage};
  std::unique_ptr<Session> Made(
      new Session(std::move(S), std::move(*Dev), std::move(*Folder)));
  Made->show(std::move(First));
  return Made;
}

std::shared_ptr<const ShownScene> Session::scene() const {
  const std::lock_guard Held(SceneLock);
  return Shown;
}

void Session::show(ShownScene Next) {
  const std::lock_guard Held(SceneLock);
  Next.Number = Shown ? Shown->Number + 1 : 1;
  Shown = std::make_shared<const ShownScene>(std::move(Next));
}

Expected<Success> Session::replace(std::string Name,
                                   const std::string &Content) {
  const std::lock_guard Held(ReplaceLock);
  const auto *First = reinterpret_cast<const std::byte *>(Content.data());
  auto File = parseScene(Name, {First, Content.size()}, Settings.Reading);
  if (!File)
    return isMeshFile({First, Content.size()})
               ? replaceMesh(std::move(Name), Content)
               : Expected<Success>(File.error());
  // Edits rewrite this file in the format of its ending, which must have
  // meshes.
  const std::string Path =
      Clock.sceneFile(scene()->Number + 1, File->Meshes > 0 ? ".glb" : "");
  if (auto Written = writeFileAtomically(Path, Content); !Written)
    return Written;
  std::shared_ptr<const Mesh> OwnMesh;
  if (File->Meshes > 0) {
    auto Read = readSent(Path, Name);
    if (!Read)
      return Read.error();
    OwnMesh = std::move(*Read);
  }
  const SceneFocus Focus = focusOf(*File);
  const auto [Width, Height] = Settings.Size.value_or(std::pair(960, 544));
  Camera Found =
      goodView(File->Gaussians, Focus, Width, Height, nearLimit(Rules::Inria));
  std::optional<float> Near;
  prepareToDraw(File->Gaussians, {Found}, Rules::Inria, Near);
  Opened = nullptr;
  ShownScene Next{.Name = std::move(Name),
                  .Path = Path,
                  .Words = Settings.ReadingWords,
                  .IsTemporary = true,
                  .File = std::move(*File),
                  .Up = Focus.Up,
                  .Found = std::move(Found),
                  .Near = Near,
                  .OwnMesh = std::move(OwnMesh),
                  .Light = scene()->Light};
  joinMeshes(Next);
  change(std::move(Next));
  return Success{};
}

/// Requires ReplaceLock.
Expected<Success> Session::replaceMesh(std::string Name,
                                       const std::string &Content) {
  const auto S = scene();
  ShownMesh Added{.Name = std::move(Name),
                  .Path = Clock.sceneFile(S->Number + 1, "-mesh"),
                  .IsTemporary = true};
  if (auto Written = writeFileAtomically(Added.Path, Content); !Written)
    return Written;
  auto Read = readSent(Added.Path, Added.Name);
  if (!Read)
    return Read.error();
  Added.Triangles = std::move(*Read);
  const auto With = [&Added](ShownScene Of) {
    Of.AddedMesh = Added;
    joinMeshes(Of);
    return Of;
  };
  if (Opened)
    Opened = std::make_shared<const ShownScene>(With(*Opened));
  change(With(*S));
  return Success{};
}

/// Shows \p Next, and removes the files of the scene before that it has not.
void Session::change(ShownScene Next) {
  const auto Before = scene();
  show(std::move(Next));
  const auto Now = scene();
  std::error_code Ignored; // it may be needed by nobody yet
  if (Before->IsTemporary && Before->Path != Now->Path)
    std::filesystem::remove(Before->Path, Ignored);
  if (Before->AddedMesh.IsTemporary &&
      Before->AddedMesh.Path != Now->AddedMesh.Path)
    std::filesystem::remove(Before->AddedMesh.Path, Ignored);
}

Expected<Success> Session::edit(const PickedRequest &R) {
  const std::lock_guard Held(ReplaceLock);
  const auto Usage = [](const char *What) {
    return Error{"", What, ExitCode::Usage};
  };
  const auto S = scene();
  if (R.Scene != S->Number)
    return Usage("another page has changed the scene, expected its number");
  if (R.Do == EditKind::Undo) {
    if (!Opened)
      return Usage("nothing is to be undone, expected an edit");
    for (unsigned &By : RemovedBy)
      By = By == Edits ? 0 : By;
    --Edits;
  } else {
    const Selection Of = selected(S->File.Gaussians, R.Parts);
    const auto Count = static_cast<std::size_t>(std::ranges::count(Of, true));
    const bool IfSelected = R.Do == EditKind::Delete;
    if (Count == 0)
      return Usage("no Gaussian is selected");
    if (Count == Of.size() && !IfSelected)
      return Usage(
          "all Gaussians are selected, which leaves nothing to remove");
    if (Count == Of.size())
      return Usage("all Gaussians are selected, expected at least one to "
                   "remain");
    if (!Opened) {
      Opened = S;
      RemovedBy.assign(Of.size(), 0);
      Edits = 0;
    }
    ++Edits;
    std::size_t At = 0;
    for (unsigned &By : RemovedBy)
      if (By == 0 && Of[At++] == IfSelected)
        By = Edits;
  }
  if (Edits == 0) {
    ShownScene Next = *std::exchange(Opened, nullptr);
    change(std::move(Next));
    return Success{};
  }
  ShownScene Next = *Opened;
  keepOnly(Next.File.Gaussians,
           [this](std::size_t I) { return RemovedBy[I] == 0; });
  // The file that is written, if it is needed, says how it is drawn.
  Next.Path = Clock.sceneFile(S->Number + 1, Next.OwnMesh ? ".glb" : "");
  Next.Words.clear();
  Next.IsTemporary = true;
  Next.Edits = Edits;
  change(std::move(Next));
  return Success{};
}

Expected<ViewAnswer> Session::selection(const PickedRequest &R) const {
  /// Points on a page that a browser draws at once.
  constexpr std::size_t MostPlaces = 20000;
  const auto S = scene();
  const Selection Of = selected(S->File.Gaussians, R.Parts);
  ViewAnswer A{{{"scene", S->Number},
                {"selected", std::ranges::count(Of, true)},
                {"gaussians", Of.size()}},
               ""};
  if (!R.View)
    return A;
  const auto Places = placesOf(S->File.Gaussians, Of, *R.View, MostPlaces);
  A.Rgba.assign(reinterpret_cast<const char *>(Places.data()),
                Places.size() * sizeof(Places[0]));
  return A;
}

Expected<std::string> Session::saved(const std::string &Name) {
  if (std::ranges::none_of(writtenEndings(), [&](std::string_view Ending) {
        return Name.ends_with(Ending);
      }))
    return Error{"",
                 fmt::format("{}: a scene has another extension, expected {}",
                             printable(Name),
                             fmt::join(writtenEndings(), ", ")),
                 ExitCode::Usage};
  const auto S = scene();
  if (S->OwnMesh && !Name.ends_with(MeshEnding))
    return Error{"",
                 fmt::format("{}: the format has no triangles, which the "
                             "scene's file has, expected {}",
                             printable(Name), MeshEnding),
                 ExitCode::Usage};
  const std::string Path = Clock.sceneFile(
      S->Number, fmt::format("-saved-{}-{}", ++Saves,
                             std::filesystem::path(Name).filename().string()));
  if (auto Done = writeShown(Path, *S); !Done)
    return Done.error();
  const auto Bytes = readFile(Path);
  std::error_code Ignored;
  std::filesystem::remove(Path, Ignored);
  if (!Bytes)
    return Bytes.error();
  return std::string(reinterpret_cast<const char *>(Bytes->data()),
                     Bytes->size());
}

std::string Session::describe() const {
  const auto S = scene();
  const Scene &Gaussians = S->File.Gaussians;
  Json Knobs = Json::array(), Cameras = Json::array(), Names = Json::array();
  // No names ask for all that the scene has.
  const auto Offered = knobsNamed({}, S->Surface.get());
  for (const Knob &K : *Offered)
    Knobs.push_back({{"name", K.Name}, {"values", K.Values}});
  if (S->Found)
    Cameras.push_back(cameraJson(*S->Found));
  else
    for (const Camera &C : Settings.Cameras)
      Cameras.push_back(cameraJson(C));
  for (const Layer L : Layers)
    if (isLayerOf(L, *S))
      Names.push_back(name(L));
  Json Warnings = Json::array();
  if (S->Surface)
    for (const MeshWarning &W : S->Surface->Warnings)
      Warnings.push_back(fmt::format("{}: {}", W.Where, W.What));
  Json Box = Json::array();
  if (Gaussians.size() != 0) {
    const SceneStatistics Of = statisticsOf(Gaussians);
    Box = {Of.InnerLow, Of.InnerHigh};
  }
  // From one end of the scale to the other, as CSS has colours.
  Json Ramp = Json::array();
  for (int Step = 0; Step <= 8; ++Step) {
    const auto Colour = heatColour(Step / 8.0);
    Ramp.push_back(fmt::format("rgb({}, {}, {})", toByte(Colour[0]),
                               toByte(Colour[1]), toByte(Colour[2])));
  }
  return jsonText(
      Json{{"name", S->Name},
           {"number", S->Number},
           {"edits", S->Edits},
           {"endings", S->OwnMesh ? std::vector{MeshEnding} : writtenEndings()},
           {"most_bytes", LargestScene},
           {"format", splat::name(S->File.Format)},
           {"gaussians", Gaussians.size()},
           {"sh_degree", Gaussians.ShDegree},
           {"triangles", S->Surface ? S->Surface->triangles() : 0},
           {"warnings", Warnings},
           {"box", Box},
           {"up", S->Up},
           {"device", Dev.name()},
           {"width", Settings.Size ? Json(Settings.Size->first) : Json()},
           {"height", Settings.Size ? Json(Settings.Size->second) : Json()},
           {"most_pixels", MostViewed},
           {"cameras", Cameras},
           {"through_lens", Settings.ThroughLens},
           {"layers", Names},
           {"ramp", Ramp},
           {"knobs", Knobs}});
}

std::string Session::number() const {
  return jsonText(Json{{"scene", scene()->Number}});
}

Expected<std::string> Session::command(const ViewRequest &R) const {
  const auto S = scene();
  if (auto Checked = checkMesh(R, *S); !Checked)
    return Checked.error();
  const std::string Stem = std::filesystem::path(S->Name).stem().string(),
                    Base = Stem + "-view";
  // Who has dropped a scene knows where its file is. An edited one has the name
  // under which the page saves it.
  const std::string Edited =
      Stem + "-edited" + (S->OwnMesh ? std::string(MeshEnding) : ".ply");
  const std::string File = S->Edits != 0    ? Edited
                           : S->IsTemporary ? S->Name
                                            : S->Path;
  std::vector<std::string> Words =
      Clock.words(File, S->AddedMesh.Name, *S, R, Base + ".json");
  if (heatOf(R.Shown))
    Words.insert(Words.end(), {"--heat-map", Base});
  if (R.Shown == Layer::Depth)
    Words.insert(Words.end(), {"--depth", Base + ".pfm"});
  Words.insert(Words.end(), {"-o", Base + ".png"});
  std::string Line = fmt::format("printf '%s\\n' {} > {} &&",
                                 shellWord(jsonText(camerasJson({R.View}))),
                                 shellWord(Base + ".json"));
  for (const auto &[Name, Text] : Settings.Machine.commandLine())
    Line += fmt::format(" {}={}", Name, shellWord(Text));
  Line += " splat";
  for (const std::string &Word : Words)
    Line += " " + shellWord(Word);
  return jsonText(Json{{"command", Line}});
}

Expected<GaussianBuffers> Session::uploaded(Launcher &L, const RenderPlan &Plan,
                                            const ShownScene &S) {
  const auto Bands = bandsOf(Plan.Effects);
  if (Uploaded == S.Number && UploadedBands == Bands)
    return OnDevice;
  // The old ones make room first.
  OnDevice = {};
  Uploaded = 0;
  L.beginStage(Stage::Upload);
  OnDevice = uploadGaussians(L, S.File.Gaussians, Plan.Effects);
  if (S.Surface)
    OnDevice.Surface = uploadMesh(L, *S.Surface, Plan.Effects);
  activate(L, Plan, OnDevice);
  if (L.failure())
    return *L.failure();
  Uploaded = S.Number;
  UploadedBands = Bands;
  return OnDevice;
}

Expected<DrawnView> Session::drawNew(const ViewRequest &R,
                                     const ShownScene &S) {
  const RenderOptions O = optionsOf(R, S);
  const ViewFacts Own = factsOfAll(S.File.Gaussians, {R.View}, O);
  const bool Continues = Facts && FactsOf == S.Number && FactsBy == O.Optics;
  Facts = Continues ? combined(*Facts, Own) : Own;
  FactsOf = S.Number;
  FactsBy = O.Optics;
  const auto Decide = [&](const ViewFacts &By, std::size_t Views) {
    return EffectPlan(EffectRequest(),
                      EffectInputs{.Gaussians = S.File.Gaussians,
                                   .Options = O,
                                   .Facts = By,
                                   .Depth = R.Shown == Layer::Depth,
                                   .Machine = Settings.Machine,
                                   .Views = Views});
  };
  // What one view has needed stays on: it changes no bit where it is not
  // needed, and programs need not be made anew with each step.
  const EffectPlan Needed = Decide(Own, 1);
  // There is always another frame, for which the scene is kept activated.
  const RenderPlan Plan = planRender(Decide(*Facts, 2), O);

  Launcher L(Dev, Settings.Kernels, {}, &Programs);
  if (auto Built = build(L, Plan, S.File.Gaussians); !Built)
    return Built.error();
  const auto Buffers = uploaded(L, Plan, S);
  if (!Buffers)
    return Buffers.error();
  auto Result = draw(L, Plan, *Buffers, R.View, O, false);
  if (!Result)
    return Result.error();
  L.recordBuilds();
  return DrawnView{S.Number, R, std::move(*Result), effectsOf(Needed)};
}

std::shared_ptr<const DrawnView> Session::findDrawn(const ViewRequest &R,
                                                    uint64_t Scene) const {
  const auto Found = std::ranges::find_if(Kept, [&](const auto &D) {
    return D->Scene == Scene && isSameView(D->Request, R) &&
           (D->Result.Depths || R.Shown != Layer::Depth);
  });
  return Found == Kept.end() ? nullptr : *Found;
}

Expected<std::shared_ptr<const DrawnView>>
Session::drawn(const ViewRequest &R,
               const std::shared_ptr<const ShownScene> &S) {
  if (auto Checked = checkMesh(R, *S); !Checked)
    return Checked.error();
  const std::lock_guard Held(DeviceLock);
  if (auto Old = findDrawn(R, S->Number))
    return Old;
  auto New = drawNew(R, *S);
  if (!New)
    return New.error();
  Kept.push_front(std::make_shared<const DrawnView>(std::move(*New)));
  if (Kept.size() > MostKept)
    Kept.pop_back();
  return Kept.front();
}

Expected<ViewAnswer> Session::frame(const ViewRequest &R, const Asker &From) {
  const PageCalls::Call Own = Calls.begin(From.Page);
  const auto GiveUp = [&] {
    return Ending || !Own.isNewest() || From.HasLeft();
  };
  const auto S = scene();
  const auto D = drawn(R, S);
  if (!D)
    return D.error();
  const RenderResult &Result = (*D)->Result;
  ViewAnswer A{factsOf(**D), ""};
  Painted P;
  if (R.Clock) {
    const auto Time = Clock.measure(*S, R, GiveUp);
    if (!Time)
      return Time.error();
    A.Facts.update(timeOf(**Time));
    if (const auto Heat = heatOf(R.Shown))
      P = paintHeat((*Time)->Tiles, *Heat, R.View.Width, R.View.Height);
  }
  if (R.Compare) {
    const auto Judged = Reference.picture(S, R.View, seenIn(Result), GiveUp);
    if (!Judged)
      return Judged.error();
    A.Facts["error"] = errorOf(Result.Picture, **Judged);
    if (R.Shown == Layer::Error)
      P = paintError(Result.Picture, **Judged);
  }
  if (R.Shown == Layer::Picture)
    P = paintPicture(Result.Picture);
  else if (R.Shown == Layer::Depth) {
    P = paintDepth(*Result.Depths);
    const auto At =
        static_cast<std::size_t>(R.Y) * static_cast<std::size_t>(R.View.Width) +
        static_cast<std::size_t>(R.X);
    A.Facts["point"] =
        pointOf(Result.Depths->Depth[At], Result.Depths->Alpha[At], R);
  }
  A.Facts["layer"] = name(R.Shown);
  A.Facts["scale"] = {{"low", P.Low},
                      {"high", P.High},
                      {"unit", P.Unit},
                      {"logarithmic", P.IsLogarithmic}};
  A.Rgba = std::move(P.Rgba);
  return A;
}

Expected<std::string> Session::pixel(const ViewRequest &R) {
  const auto S = scene();
  ViewRequest Plain = R;
  Plain.Shown = Layer::Picture;
  std::shared_ptr<const DrawnView> D;
  if (S->Surface) {
    // The machine says which triangles are seen.
    auto Drawn = drawn(Plain, S);
    if (!Drawn)
      return Drawn.error();
    D = std::move(*Drawn);
  } else {
    const std::lock_guard Held(DeviceLock);
    D = findDrawn(Plain, S->Number);
  }
  Json Gaussians = Json::array(), Triangles = Json::array();
  std::array<double, 3> Sum{};
  double Depths = 0, Weights = 0;
  const auto Add = [&](const auto &Part) {
    for (std::size_t K = 0; K != Sum.size(); ++K)
      Sum[K] += Part.Weight * Part.Color[K];
    Depths += Part.Weight * Part.Depth;
    Weights += Part.Weight;
  };
  const PixelParts Parts =
      Reference.pixel(S, R, D ? seenIn(D->Result) : nullptr);
  for (const PixelGaussian &G : Parts.Gaussians) {
    Add(G);
    Gaussians.push_back({{"index", G.Index},
                         {"weight", G.Weight},
                         {"alpha", G.Alpha},
                         {"depth", G.Depth},
                         {"color", G.Color},
                         {"tiles", G.Tiles},
                         {"pixels", G.Pixels},
                         {"error", G.Error}});
  }
  for (const PixelTriangle &T : Parts.Triangles) {
    Add(T);
    Triangles.push_back(triangleOf(T, *S));
  }
  Json Pixel{{"x", R.X}, {"y", R.Y}, {"reference", Sum}};
  if (D) {
    const auto At = 3 * (static_cast<std::size_t>(R.Y) *
                             static_cast<std::size_t>(R.View.Width) +
                         static_cast<std::size_t>(R.X));
    const auto Of = std::span(D->Result.Picture.Render).subspan(At, 3);
    Pixel["machine"] = std::array{Of[0], Of[1], Of[2]};
  }
  Pixel["point"] = pointOf(Depths, Weights, R);
  Pixel["gaussians"] = std::move(Gaussians);
  Pixel["triangles"] = std::move(Triangles);
  return jsonText(Pixel);
}

} // namespace vorion::splat
