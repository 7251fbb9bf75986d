#include "accuracy/HostTime.h"
#include "accuracy/Page.h"
#include "accuracy/Sweep.h"
#include "accuracy/Verdict.h"
#include "commands/AccuracyTrain.h"
#include "commands/CameraArguments.h"
#include "commands/Commands.h"
#include "commands/MeshArguments.h"
#include "commands/OutputFile.h"
#include "commands/SceneArguments.h"
#include "commands/StudyArguments.h"
#include "commands/Usage.h"
#include "device/ClockedMachine.h"
#include "io/ReportHead.h"
#include "mesh/Mesh.h"
#include "picture/View.h"
#include "render/MeshRules.h"
#include "scene/formats/Formats.h"
#include "scene/formats/GltfWriter.h"
#include "study/Study.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Hash.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <ranges>
#include <string>
#include <system_error>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

struct AccuracyArguments {
  SceneArguments Scene;
  CameraArguments Cameras;
  MeshArguments Mesh;
  StudyOptions Study;
  double MinDb = 50;
  std::vector<std::string> Check, Knobs;
  unsigned Products = 64, ThumbWidth = 240;
  bool NoCores = false, Energy = false, NoHost = false;
  TrainSweepPlan Train; ///< where a capture is given
};

/// Whether the views are in no file yet.
bool hasOwnCameras(const AccuracyArguments &A) {
  const CameraArguments &C = A.Cameras;
  return C.File.empty() || C.Orbit != 0 || C.Frames != 0 || !C.Size.empty() ||
         C.Distorted;
}

/// Where they are kept then, for the processes that draw.
std::string ownCameras(const AccuracyArguments &A) {
  return A.Study.Folder + "/cameras.json";
}

/// The mesh beside the Gaussians of the scene, null without any. Only glTF
/// files have one, so that no other scene is read for it.
Expected<std::shared_ptr<const Mesh>> loadOwnMesh(const SceneArguments &A) {
  std::error_code Ignored;
  if (std::filesystem::is_directory(A.Path, Ignored))
    return std::shared_ptr<const Mesh>();
  const auto Content = readFile(A.Path);
  if (!Content)
    return Content.error();
  if (!isGltf(*Content))
    return std::shared_ptr<const Mesh>();
  const auto File = loadScene(A);
  return File ? loadOwnMesh(A, *File)
              : Expected<std::shared_ptr<const Mesh>>(File.error());
}

/// Reads the mesh of \p P, whose views must show it.
Expected<Success> loadMesh(const AccuracyArguments &A, SweepPlan &P) {
  auto Own = loadOwnMesh(A.Scene);
  if (!Own)
    return Own.error();
  auto Added = loadAddedMesh(A.Mesh);
  if (!Added)
    return Added.error();
  P.Surface = joined(std::move(*Own), std::move(*Added), {});
  P.Light = A.Mesh.Light;
  if (P.Light && !P.Surface)
    return lightWithoutMesh();
  for (const Camera &View : P.Views) {
    RenderOptions O;
    O.Surface = P.Surface;
    if (auto Through = drawThrough(O, P.CameraFile, {View}); !Through)
      return Through;
    if (auto Checked = checkMeshCamera(O, P.CameraFile); !Checked)
      return Checked;
  }
  const std::vector<std::string> Words = wordsOf(A.Mesh);
  P.CommonArguments.insert(P.CommonArguments.end(), Words.begin(), Words.end());
  return Success{};
}

/// Of the mesh and the light of \p P.
Expected<std::string> hashMesh(const SweepPlan &P) {
  GltfWriter As;
  addMesh(As, *P.Surface);
  const auto Bytes = As.finish();
  if (!Bytes)
    return Bytes.error();
  return P.Light
             ? fnv1a64(fmt::format("{} {}", *Bytes, fmt::join(*P.Light, " ")))
             : fnv1a64(*Bytes);
}

/// Of the knobs of \p P, which have no modelled cost; empty if all have one.
std::string withoutCost(const SweepPlan &P) {
  std::vector<std::string> Names;
  for (const Knob &K : P.Knobs)
    if (!K.HasCost)
      Names.push_back(K.Name);
  return Names.empty()
             ? ""
             : fmt::format("no cost modelled: {} (cycles are those of kernels "
                           "that round)",
                           fmt::join(Names, ", "));
}

Expected<SweepPlan> planOf(const AccuracyArguments &A,
                           const DeviceOptions &Machine) {
  SweepPlan P;
  P.Machine = Machine;
  P.ScenePath = A.Scene.Path;
  P.Folder = A.Study.Folder;
  P.CommonArguments = wordsOf(A.Scene);
  P.CameraFile = hasOwnCameras(A) ? ownCameras(A) : A.Cameras.File;
  auto Views = studyViews(A.Cameras, A.Scene, P.CameraFile);
  if (!Views)
    return Views.error();
  P.Views = std::move(*Views);
  const std::string SceneWords =
      fmt::format("{}", fmt::join(P.CommonArguments, " "));
  if (auto Loaded = loadMesh(A, P); !Loaded)
    return Loaded.error();
  auto Knobs = knobsNamed(A.Knobs, P.Surface.get(),
                          std::ranges::any_of(P.Views, [](const Camera &View) {
                            return View.Optics.Model->IsParallel;
                          }));
  if (!Knobs)
    return Knobs.error();
  P.Knobs = std::move(*Knobs);
  P.Cores = !A.NoCores;
  P.Energy = A.Energy;
  P.ThumbWidth = A.ThumbWidth;
  P.Load = [&A] { return loadScene(A.Scene); };
  auto From = sceneProvenance(A.Scene, Machine);
  if (!From)
    return From.error();
  P.From = std::move(*From);
  P.From["options"] = fmt::format("{}{} --thumb-width {}", SceneWords,
                                  P.Cores ? "" : " --no-cores", P.ThumbWidth);
  if (P.Surface) {
    auto Hash = hashMesh(P);
    if (!Hash)
      return Hash.error();
    P.From["mesh"] = std::move(*Hash);
  }
  return P;
}

/// Views that choose and views that check.
struct Split {
  std::vector<const Camera *> Choose, Check;
};

Expected<Split> splitViews(const SweepPlan &P,
                           const std::vector<std::string> &Check) {
  Split S;
  for (const std::string &Name : Check)
    if (std::none_of(P.Views.begin(), P.Views.end(),
                     [&](const Camera &C) { return C.Name == Name; }))
      return usage(fmt::format(
          "--check {}: no such view, expected one of --view{}", Name,
          didYouMean(Name, std::views::transform(P.Views, &Camera::Name))));
  for (const Camera &View : P.Views) {
    // Unless told, the last of several views checks.
    const bool Checks =
        Check.empty()
            ? P.Views.size() > 1 && &View == &P.Views.back()
            : std::find(Check.begin(), Check.end(), View.Name) != Check.end();
    (Checks ? S.Check : S.Choose).push_back(&View);
  }
  if (S.Choose.empty())
    return usage("--check names all views, expected at least one view for "
                 "choosing the setting");
  return S;
}

/// The settings so far: single knobs, and once they are all measured the
/// product of the fronts.
Expected<std::vector<Setting>> currentSettings(const SweepPlan &P,
                                               PointStore &Kept, const Split &V,
                                               double FloorDb,
                                               std::size_t Products) {
  std::vector<Setting> All = singleChanges(P.Knobs);
  const auto Missing =
      missing(Kept, studyPoints(P, pointsOf(P, All), logStudy));
  if (!Missing.empty() || Products == 0)
    return All;
  const auto Measured = candidates(P, Kept, All, V.Choose);
  if (!Measured)
    return Measured.error();
  for (Setting &S : productOfFronts(P.Knobs, *Measured, FloorDb, Products))
    All.push_back(std::move(S));
  return All;
}

std::vector<std::string> nameList(const std::vector<const Camera *> &Views) {
  std::vector<std::string> Names;
  Names.reserve(Views.size());
  for (const Camera *View : Views)
    Names.push_back(View->Name);
  return Names;
}

std::string names(const std::vector<const Camera *> &Views) {
  return fmt::format("{}", fmt::join(nameList(Views), ","));
}

std::vector<const Camera *> pointersTo(const std::vector<Camera> &Views) {
  std::vector<const Camera *> All;
  All.reserve(Views.size());
  for (const Camera &View : Views)
    All.push_back(&View);
  return All;
}

Expected<std::string> recommendation(const SweepPlan &P, PointStore &Kept,
                                     const Split &V,
                                     const std::vector<Setting> &All,
                                     double FloorDb) {
  const auto Measured = candidates(P, Kept, All, V.Choose);
  if (!Measured)
    return Measured.error();
  const auto First = readPoint(P, Kept, {Setting(), V.Choose.front()});
  if (!First)
    return First.error();
  std::string Text =
      fmt::format("machine: {}\n{}; at least {} dB on {}:\n",
                  escaped((*First)[ClockedMachineKey].get<std::string>()),
                  counted(All.size(), "setting"), FloorDb, names(V.Choose));
  for (std::size_t A = 0; A < TimeAxes; ++A) {
    const auto Axis = static_cast<TimeAxis>(A);
    if (Axis == TimeAxis::Energy && !P.Energy)
      continue;
    Text += fmt::format("{:<18}", TimeAxisNames[A]);
    const auto Best = recommend(*Measured, Axis, FloorDb);
    if (!Best) {
      Text += "none\n";
      continue;
    }
    const Candidate &C = (*Measured)[*Best];
    const auto Gain = [&](const Candidate &Of, const Candidate &Base) {
      const double Default = *Base.time(Axis);
      return fmt::format("{:.1f} dB, {:+.1f} % of the default's {}",
                         judged({Of}, ErrorKind::Psnr, Axis).front().Merit,
                         100 * (*Of.time(Axis) / Default - 1),
                         Axis == TimeAxis::Energy
                             ? fmt::format("{:.4g} mJ", 1e3 * Default)
                             : fmt::format("{:.4g} M cycles", 1e-6 * Default));
    };
    Text += fmt::format("{}: {}", C.Chosen.name(), Gain(C, Measured->front()));
    if (!V.Check.empty()) {
      const auto Checked = candidates(P, Kept, {Setting(), C.Chosen}, V.Check);
      if (!Checked)
        return Checked.error();
      Text += fmt::format("; on {}: {}", names(V.Check),
                          Gain(Checked->back(), Checked->front()));
    }
    Text += '\n';
  }
  return Text;
}

/// The sentence that answers, by all views.
Expected<std::string> verdict(SweepPlan P, PointStore &Kept,
                              const std::vector<Setting> &All, double FloorDb) {
  P.Energy = true; // it costs, whether or not it is an axis
  const auto Measured = candidates(P, Kept, All, pointersTo(P.Views));
  if (!Measured)
    return Measured.error();
  const auto First = readPoint(P, Kept, {Setting(), &P.Views.front()});
  if (!First)
    return First.error();
  return verdictOf(*Measured, FloorDb,
                   (*First)[ClockedMachineKey].get<std::string>());
}

/// Views for the host's time: those of \p P, or of a single one and its file's
/// others a few, so that one can be a sample of the others.
std::vector<Camera> hostViews(const AccuracyArguments &A, const SweepPlan &P) {
  constexpr std::size_t Most = 3;
  std::vector<Camera> Views = P.Views;
  if (Views.size() == 1 && !hasOwnCameras(A)) {
    CameraArguments All = A.Cameras;
    All.Views = {"all"};
    if (const auto Others = chooseCameras(All, SceneFile()))
      for (const Camera &View : *Others)
        if (View.Name != P.Views.front().Name)
          Views.push_back(View);
  }
  Views.resize(std::min(Views.size(), Most));
  return Views;
}

/// All measurements without pictures, and the page.
Expected<Success> writeResults(const SweepPlan &P, PointStore &Kept,
                               const PageHead &Head,
                               const std::vector<Setting> &All) {
  Json Points = Json::array();
  for (const Point &Of : pointsOf(P, All)) {
    auto One = readPoint(P, Kept, Of);
    if (!One)
      return One.error();
    for (const char *Picture : {"picture", "difference"})
      One->erase(Picture);
    Points.push_back(std::move(*One));
  }
  Json Report = reportHead("splat-accuracy");
  Report.update({{"verdict", Head.Verdict},
                 {"host", hostTimeJson(Head.Host)},
                 {"made", Head.Made},
                 {"points", std::move(Points)}});
  const auto Page = pageOf(P, Kept, Head, All);
  return Page ? writeStudy(P.Folder, "accuracy.json", Report, *Page)
              : Expected<Success>(Page.error());
}

/// Measures the host's time, writes the results and prints the answer.
Expected<Success> finish(const AccuracyArguments &A, const SweepPlan &P,
                         PointStore &Kept, const Split &V, double FloorDb) {
  const auto All = currentSettings(P, Kept, V, FloorDb, A.Products);
  if (!All)
    return All.error();
  auto Answer = verdict(P, Kept, *All, FloorDb);
  if (!Answer)
    return Answer.error();
  const std::vector<Camera> OnHost = hostViews(A, P);
  Expected<std::vector<HostTime>> Host = std::vector<HostTime>();
  if (!A.NoHost)
    Host = measureHostTime(P, OnHost, logStudy);
  if (!Host)
    return Host.error();
  const std::string Costless = withoutCost(P);
  const PageHead Head{
      *Answer, *Host,
      fmt::format("{}{}, views {} (chosen on {}), {}x{}, rules inria, errors "
                  "against the fp64 reference of the same support{}{}",
                  P.ScenePath, P.Surface ? " with a mesh" : "",
                  names(pointersTo(P.Views)), names(V.Choose),
                  P.Views.front().Width, P.Views.front().Height,
                  Costless.empty() ? "" : "; ", Costless),
      FloorDb, V.Choose};
  if (auto Written = writeResults(P, Kept, Head, *All); !Written)
    return Written;
  const auto Text = recommendation(P, Kept, V, *All, FloorDb);
  if (!Text)
    return Text.error();
  printOut("{}\n\n{}", *Answer, *Text);
  if (!Costless.empty())
    printOut("{}\n", Costless);
  if (!A.NoHost)
    printOut("\n{}", hostTimeText(*Host, OnHost));
  printOut("{}/index.html\n", escaped(P.Folder));
  return Success{};
}

/// All points so far: what the first round finds out says what the second
/// measures.
Expected<std::vector<StudyPoint>> roundOf(const AccuracyArguments &A,
                                          const SweepPlan &P, PointStore &Kept,
                                          const Split &V, double FloorDb) {
  const auto All = currentSettings(P, Kept, V, FloorDb, A.Products);
  if (!All)
    return All.error();
  return studyPoints(P, pointsOf(P, *All), logStudy);
}

Expected<std::vector<StudyPoint>> named(const SweepPlan &P,
                                        const std::vector<std::string> &Names) {
  std::vector<Point> Wanted;
  for (const std::string &Name : Names) {
    auto One = pointNamed(P, Name);
    if (!One)
      return One.error();
    Wanted.push_back(std::move(*One));
  }
  return studyPoints(P, Wanted, logStudy);
}

Expected<Success> run(AccuracyArguments &A, const DeviceOptions &Machine) {
  if (!A.Train.Capture.empty()) {
    A.Train.Folder = A.Study.Folder;
    A.Train.Energy = A.Energy;
    A.Train.Machine = Machine;
    return measureTraining(A.Train, A.Study);
  }
  if (A.Scene.Path.empty())
    return usage("no input, expected a scene or --train CAPTURE");
  const auto P = planOf(A, Machine);
  if (!P)
    return P.error();
  const auto V = splitViews(*P, A.Check);
  if (!V)
    return V.error();
  PointStore Kept = storeOf(*P, logStudy);
  StudySteps Steps;
  Steps.Round = [&] { return roundOf(A, *P, Kept, *V, A.MinDb); };
  Steps.Named = [&P](const std::vector<std::string> &Names) {
    return named(*P, Names);
  };
  if (hasOwnCameras(A))
    Steps.Begin = [&] { return writeCameras(ownCameras(A), P->Views); };
  Steps.End = [&] { return finish(A, *P, Kept, *V, A.MinDb); };
  return runStudy(A.Study, Kept, Steps, logStudy);
}

} // namespace

Runner addAccuracy(CLI::App &App) {
  auto A = std::make_shared<AccuracyArguments>();
  addStudyOptions(App, A->Study, "point",
                  "the scene's or the capture's name and -accuracy");
  const HelpGroup Group(App, "Study");
  App.add_flag("--energy", A->Energy,
               "Add energy as an objective (docs/energy.md)");
  const std::size_t First = App.get_options().size();
  addSceneOptions(App, A->Scene);
  App.get_option("scene")->required(false);
  A->Scene.KeepsMeshes = true;
  addMeshOptions(App, A->Mesh);
  addCameraOptions(App, A->Cameras, /*Several=*/true);
  takesView(App.add_option("--view", A->Cameras.Views,
                           "Views to measure (default: all)"))
      ->delimiter(',')
      ->option_text("VIEW,...");
  takesView(App.add_option(
                "--check", A->Check,
                "Views of these that validate the recommended setting and are "
                "not used for choosing it (default: the last of several)"))
      ->delimiter(',')
      ->option_text("VIEW,...");
  takesSomeOf(
      App.add_option("--knobs", A->Knobs, "Options to try (default: all)"),
      knobNames())
      ->delimiter(',')
      ->option_text("KNOB,...");
  App.add_option("--min-db", A->MinDb,
                 "Minimum PSNR of the recommended setting on every view that "
                 "is used for choosing (default 50)")
      ->check(isBetween(-1000.0, 1000.0));
  App.add_option("--products", A->Products,
                 "Maximum number of combinations of the Pareto fronts' knobs "
                 "(default 64)")
      ->check(isBetween(0U, 1000000U))
      ->option_text("N");
  App.add_flag("--no-cores", A->NoCores, "Skip the simt path");
  App.add_flag("--no-host", A->NoHost,
               "Skip the measurement of simulation time on the host");
  App.add_option("--thumb-width", A->ThumbWidth,
                 "Width of the page's pictures in pixels (default 240)")
      ->check(isBetween(8U, 4096U))
      ->option_text("N");
  addTrainOptions(App, A->Train, optionsFrom(App, First));
  return [A](const DeviceOptions &Machine) {
    nameOutput("-o", A->Study.Folder,
               A->Train.Capture.empty() ? A->Scene.Path : A->Train.Capture,
               "-accuracy");
    auto Done = run(*A, Machine);
    return Done ? writeStudyFigures(A->Study) : Done;
  };
}

} // namespace vorion::splat
