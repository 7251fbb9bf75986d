#include "view/Session.h"

#include "cameras/GoodView.h"
#include "device/ClockedMachine.h"
#include "effects/Registry.h"
#include "io/CameraLens.h"
#include "io/Metrics.h"
#include "render/Explain.h"
#include "render/Pictures.h"
#include "scene/Statistics.h"
#include "view/Paint.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <span>
#include <utility>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// Pictures that are kept: two settings of one view with and without what takes
/// longer.
constexpr std::size_t MostKept = 4;

/// Whether a camera of \p M has a picture without its lens, too: a sphere has
/// none, and parallel rays have no focal length.
bool bends(const LensModel &M) { return !M.Keys.empty(); }

Json cameraJson(const Camera &C) {
  return {{"name", C.Name},
          {"width", C.Width},
          {"height", C.Height},
          {"position", C.Position},
          {"rotation", C.Rotation},
          {"fx", C.Fx},
          {"fy", C.Fy},
          {"cx", C.Cx},
          {"cy", C.Cy},
          {"lens", lensJson(C.Optics)},
          {"lens_is_a_choice", bends(*C.Optics.Model)}};
}

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
    return File.error();
  const std::string Path = Clock.sceneFile(scene()->Number + 1);
  if (auto Written = writeFileAtomically(Path, Content); !Written)
    return Written;
  const std::string Before = Clock.sceneFile(scene()->Number);
  const Vector Up = focusOf(File->Gaussians).Up;
  show({std::move(Name), Path, Settings.ReadingWords, std::move(*File), Up});
  std::error_code Ignored; // there is none of the first scene
  std::filesystem::remove(Before, Ignored);
  return Success{};
}

std::string Session::describe() const {
  const auto S = scene();
  const Scene &Gaussians = S->File.Gaussians;
  Json Knobs = Json::array(), Cameras = Json::array(), Names = Json::array();
  for (const Knob &K : allKnobs())
    Knobs.push_back({{"name", K.Name}, {"values", K.Values}});
  // A scene that was dropped has no cameras that we know of.
  if (S->Number == 1)
    for (const Camera &C : Settings.Cameras)
      Cameras.push_back(cameraJson(C));
  for (const Layer L : Layers)
    Names.push_back(name(L));
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
  return jsonText(Json{{"name", S->Name},
                       {"number", S->Number},
                       {"most_bytes", LargestScene},
                       {"format", splat::name(S->File.Format)},
                       {"gaussians", Gaussians.size()},
                       {"sh_degree", Gaussians.ShDegree},
                       {"box", Box},
                       {"up", S->Up},
                       {"device", Dev.name()},
                       {"width", Settings.Width},
                       {"height", Settings.Height},
                       {"cameras", Cameras},
                       {"through_lens", Settings.ThroughLens},
                       {"layers", Names},
                       {"ramp", Ramp},
                       {"knobs", Knobs}});
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
  activate(L, Plan, OnDevice);
  if (L.failure())
    return *L.failure();
  Uploaded = S.Number;
  UploadedBands = Bands;
  return OnDevice;
}

Expected<DrawnView> Session::drawNew(const ViewRequest &R,
                                     const ShownScene &S) {
  const RenderOptions O = optionsOf(R, S.File.DrawnAs);
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
    const auto Judged = Reference.picture(S, R.View, GiveUp);
    if (!Judged)
      return Judged.error();
    A.Facts["error"] = errorOf(Result.Picture, **Judged);
    if (R.Shown == Layer::Error)
      P = paintError(Result.Picture, **Judged);
  }
  if (R.Shown == Layer::Picture)
    P = paintPicture(Result.Picture);
  else if (R.Shown == Layer::Depth)
    P = paintDepth(*Result.Depths);
  A.Facts["layer"] = name(R.Shown);
  A.Facts["scale"] = {{"low", P.Low}, {"high", P.High}, {"unit", P.Unit}};
  A.Rgba = std::move(P.Rgba);
  return A;
}

std::string Session::pixel(const ViewRequest &R) {
  const auto S = scene();
  Json Gaussians = Json::array();
  std::array<double, 3> Sum{};
  for (const PixelGaussian &G : Reference.pixel(S, R)) {
    for (std::size_t K = 0; K != Sum.size(); ++K)
      Sum[K] += G.Weight * G.Color[K];
    Gaussians.push_back({{"index", G.Index},
                         {"weight", G.Weight},
                         {"alpha", G.Alpha},
                         {"depth", G.Depth},
                         {"color", G.Color},
                         {"tiles", G.Tiles},
                         {"pixels", G.Pixels},
                         {"error", G.Error}});
  }
  Json Pixel{{"x", R.X}, {"y", R.Y}, {"reference", Sum}};
  std::shared_ptr<const DrawnView> D;
  {
    const std::lock_guard Held(DeviceLock);
    ViewRequest Plain = R;
    Plain.Shown = Layer::Picture;
    D = findDrawn(Plain, S->Number);
  }
  if (D) {
    const auto At = 3 * (static_cast<std::size_t>(R.Y) *
                             static_cast<std::size_t>(R.View.Width) +
                         static_cast<std::size_t>(R.X));
    const auto Of = std::span(D->Result.Picture.Render).subspan(At, 3);
    Pixel["machine"] = std::array{Of[0], Of[1], Of[2]};
  }
  Pixel["gaussians"] = std::move(Gaussians);
  return jsonText(Pixel);
}

} // namespace vorion::splat
