#include "train/run/Trainer.h"

#include "io/Bytes.h"
#include "io/Image.h"
#include "io/Metrics.h"
#include "train/data/Philox.h"
#include "train/optimize/Adam.h"

#include "picture/Layout.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vorion::splat {

std::vector<ProgramSpec> Trainer::programs(const TrainSettings &Settings,
                                           const TrainingSet &Pictures,
                                           MomentsOn Where, RendererKind Kind) {
  std::vector<ProgramSpec> Programs = densityPrograms(Kind);
  Programs.push_back(lossProgram());
  Programs.push_back(adamProgram(Where));
  Programs.push_back(batchProgram());
  if (std::ranges::any_of(Pictures.Training,
                          [](const TrainView &V) { return !V.Counts.empty(); }))
    Programs.push_back(maskProgram());
  if (Settings.Method == DensityMethod::Mcmc)
    Programs.push_back(mcmcProgram());
  if (isRegularized(Settings))
    Programs.push_back(regularizeProgram());
  if (isExposureOn(Settings))
    Programs.push_back(exposureProgram());
  if (arePosesOn(Settings))
    Programs.push_back(poseProgram());
  return Programs;
}

/// In the frame with the origin \p Origin.
static std::vector<Camera> camerasOf(const std::vector<TrainView> &Views,
                                     const WorldPoint &Origin) {
  std::vector<Camera> Cameras;
  Cameras.reserve(Views.size());
  for (const TrainView &V : Views)
    Cameras.push_back(relativeTo(V.Pose, Origin));
  return Cameras;
}

Trainer::Trainer(Launcher &Launch, GradientRenderer &Render,
                 const TrainingSet &Photos, const TrainRun &What,
                 Ranks &Processes, MomentsOn MomentsAre)
    : Launch(Launch), Renderer(Render), Pictures(Photos), Run(What),
      Order(Photos.Training.size(), What.Seed),
      Loss(Launch, What.Settings.DSsim),
      Exposed(Launch, What.Settings, Photos.Training.size()),
      Posed(Launch, What.Settings, camerasOf(Photos.Training, What.Origin),
            What.Extent),
      Processes(Processes),
      Density(Launch, What.Settings, What.Seed, What.Extent),
      Mcmc(Launch, What.Settings, What.Seed),
      Batch(Launch, Density, What.Batch), Share(Launch, Processes),
      Where(MomentsAre) {}

void Trainer::start(const Scene &From) {
  Launch.beginStage(Stage::Upload);
  State = DeviceScene::upload(Launch, From, Where);
  Density.restart(State.Count);
  Exposed.restart();
  Posed.restart();
  Done = 0;
  Losses.clear();
}

void Trainer::restore(const Checkpoint &C) {
  Launch.beginStage(Stage::Upload);
  State = DeviceScene();
  State.Count = static_cast<uint32_t>(C.gaussians());
  State.ShDegree = C.ShDegree;
  State.Parameters = State.allocate(Launch, State.Count);
  Launch.write("Gaussians' geometry", State.Parameters.Geometry,
               C.Geometry.data(), 4 * C.Geometry.size());
  Launch.write("Gaussians' colours", State.Parameters.Sh, C.Sh.data(),
               4 * C.Sh.size());
  State.First = {{Launch, Where, C.FirstGeometry}, {Launch, Where, C.FirstSh}};
  State.Second = {{Launch, Where, C.SecondGeometry},
                  {Launch, Where, C.SecondSh}};
  State.uploadIdentities(Launch, C.Identities);
  Density.restore(C.Notes);
  Exposed.restore(C.Exposures);
  Posed.restore(C.Poses);
  Done = C.Iteration;
  Losses = C.Losses;
}

Checkpoint Trainer::save() {
  Launch.beginStage(Stage::ReadBack);
  Checkpoint C;
  C.Iteration = Done;
  C.ShDegree = State.ShDegree;
  C.Geometry.resize(std::size_t{GEOMETRY_PLANES} * State.Count);
  C.Sh.resize(std::size_t{State.colourPlanes()} * State.Count);
  Launch.read("Gaussians' geometry", C.Geometry.data(),
              State.Parameters.Geometry, 4 * C.Geometry.size());
  Launch.read("Gaussians' colours", C.Sh.data(), State.Parameters.Sh,
              4 * C.Sh.size());
  C.FirstGeometry = State.First.Geometry.values(Launch, C.Geometry.size());
  C.FirstSh = State.First.Sh.values(Launch, C.Sh.size());
  C.SecondGeometry = State.Second.Geometry.values(Launch, C.Geometry.size());
  C.SecondSh = State.Second.Sh.values(Launch, C.Sh.size());
  C.Identities = State.downloadIdentities(Launch);
  C.Notes = Density.save(State.Count);
  C.Losses = Losses;
  C.Exposures = Exposed.save();
  C.Poses = Posed.save();
  return C;
}

const TrainView &Trainer::sized(std::size_t View) {
  const int Factor = shrinkAt(Run.Settings, Done + 1);
  if (Factor == 1)
    return Pictures.Training[View];
  if (Factor != Shrink) {
    Smaller.assign(Pictures.Training.size(), std::nullopt);
    Shrink = Factor;
  }
  std::optional<TrainView> &V = Smaller[View];
  if (!V) {
    V = shrunk(Pictures.Training[View], Factor);
    // A mask may leave no pixel of it.
    if (!V->Counts.empty() &&
        std::ranges::find(V->Counts, 1) == V->Counts.end())
      V = Pictures.Training[View];
  }
  return *V;
}

cl::Buffer Trainer::forward(std::size_t View, const TrainView &Sized,
                            int ShDegree) {
  Camera C = Posed.at(View);
  if (C.Width != Sized.Pose.Width || C.Height != Sized.Pose.Height)
    C = stretched(C, Sized.Pose.Width, Sized.Pose.Height);
  return Renderer.forward(State, C, ShDegree);
}

/// \p Place: of the view in the whole run, from 1.
ViewBatch::ViewResult Trainer::take(uint64_t Place, int ShDegree) {
  const std::size_t View = Order.at(Place);
  const TrainView &V = sized(View);
  if (!Run.RandomBackground)
    return lossOf(forward(View, V, ShDegree), View, V, V.Picture);
  const philox_words W =
      philox(static_cast<uint>(Run.Seed), static_cast<uint>(Run.Seed >> 32),
             static_cast<uint>(Place), static_cast<uint>(Place >> 32), 0,
             STREAM_BACKGROUND);
  const std::array<float, 3> Colour{
      philox_unit(W.word[0]), philox_unit(W.word[1]), philox_unit(W.word[2])};
  Renderer.setBackground(Colour);
  const cl::Buffer Drawn = forward(View, V, ShDegree);
  return lossOf(Drawn, View, V, over(V, Run.Background, Colour));
}

ViewBatch::ViewResult Trainer::lossOf(const cl::Buffer &Picture,
                                      std::size_t View, const TrainView &Sized,
                                      const Photo &Target) {
  Launch.beginStage(Stage::Loss);
  const auto Pixels = static_cast<uint32_t>(Target.pixels());
  ViewBatch::ViewResult R;
  if (Exposed.areOn()) {
    // An exposure's gradient is a sum over all pixels.
    R.Loss = Loss.evaluate(Exposed.apply(Picture, Pixels, View), Target,
                           Sized.Counts);
    R.ByExposure = Exposed.back(Picture, Loss.gradient(), Pixels, View);
  } else {
    R.Loss = Loss.evaluate(Picture, Target, Sized.Counts, Division);
  }
  R.Back =
      Renderer.backward(Loss.gradient(), Loss.alphaGradient(), depthsOf(Sized));
  if (Posed.areOn())
    R.ByPose = Posed.slope(View, State.Parameters, R.Back, State.Count);
  return R;
}

/// The weight is that of the mean over the picture's points.
DepthTargets Trainer::depthsOf(const TrainView &V) const {
  const std::vector<DepthPoint> &Points = V.Depths;
  return {&Points, static_cast<float>(Run.Settings.DepthWeight * Run.Extent /
                                      static_cast<double>(Points.size()))};
}

void Trainer::stepExposures() {
  std::vector<Exposures::Slope> Slopes;
  for (const ExposureMatrix &By : Batch.byExposures())
    Slopes.push_back(
        {Order.at(uint64_t{Done} * Run.Batch + Slopes.size() + 1), By});
  Exposed.step(Slopes, Done + 1);
}

void Trainer::stepPoses() {
  std::vector<Poses::Slope> Slopes;
  for (const PoseSlope &By : Batch.byPoses())
    Slopes.push_back(
        {Order.at(uint64_t{Done} * Run.Batch + Slopes.size() + 1), By});
  Posed.step(Slopes, Done + 1);
}

/// What is due after the last iteration, once there is a next one: a scene that
/// was just split or made transparent is worse than the one before, and no run
/// ends with it. (INRIA's trainer saves before the change, too, but makes it
/// before the step, which the new Gaussians and their neighbours then miss.)
std::optional<DensityChange> Trainer::changeDensity() {
  Launch.beginStage(Stage::DensityControl);
  // The change needs the gradients' memory.
  Batch.forget();
  Renderer.forget();
  std::optional<DensityChange> Change;
  if (densifiesAt(Run.Settings, Done) &&
      Run.Settings.Method == DensityMethod::Mcmc) {
    Change = Mcmc.change(State, Done);
    Density.restart(State.Count);
  } else if (densifiesAt(Run.Settings, Done)) {
    Change = Density.densify(State, Done);
  }
  if (resetsAt(Run.Settings, Done, Run.isWhite()))
    Density.resetOpacity(State);
  return Change;
}

bool Trainer::isChangeDue() const {
  return Done != 0 && (densifiesAt(Run.Settings, Done) ||
                       resetsAt(Run.Settings, Done, Run.isWhite()));
}

StepReport Trainer::step(bool Whole) {
  const TrainSettings &Settings = Run.Settings;
  StepReport R;
  R.Iteration = Done + 1;
  // A process that failed here would have other sizes than the others.
  if (isChangeDue()) {
    R.Density = changeDensity();
    if (!Processes.allSucceeded(Launch))
      return R;
  }
  Division = Processes.size() == 1 || Whole ? nullptr : &Share;
  if (!Renderer.divide(Division))
    Division = nullptr;
  const int Degree = shDegreeAt(Settings, R.Iteration, State.ShDegree);
  Batch.begin(State, Degree, notesAt(Settings, R.Iteration));
  while (!Batch.complete())
    Batch.add(take(uint64_t{Done} * Run.Batch + Batch.next() + 1, Degree));
  R.Loss = Batch.loss();
  if (!std::isfinite(R.Loss.Value))
    Launch.fail({"",
                 fmt::format("the loss of iteration {} is {}, expected a "
                             "finite loss: training diverged",
                             R.Iteration, R.Loss.Value),
                 ExitCode::GuestFailed});
  Launch.beginStage(Stage::Adam);
  if (isRegularized(Settings))
    regularize(Launch, Settings, State, Batch.gradients());
  stepAdam(Launch, Settings, State, Batch.gradients(), R.Iteration, Run.Extent,
           Degree);
  if (Exposed.areOn())
    stepExposures();
  if (Posed.areOn())
    stepPoses();
  if (Settings.Method == DensityMethod::Mcmc)
    Mcmc.addNoise(State, R.Iteration,
                  positionRate(Settings, R.Iteration) * Run.Extent *
                      Settings.NoiseRate);
  if (!Processes.allSucceeded(Launch))
    return R;
  Done = R.Iteration;
  Losses.push_back(static_cast<float>(R.Loss.Value));
  R.Gaussians = State.Count;
  return R;
}

Scene Trainer::scene() {
  Launch.beginStage(Stage::ReadBack);
  Scene S = State.download(Launch);
  S.Origin = Run.Origin;
  return S;
}

Camera Trainer::pose(std::size_t View) const {
  Camera C = Posed.at(View);
  for (std::size_t A = 0; A < 3; ++A)
    C.Position[A] += Run.Origin[A];
  return C;
}

Photo Trainer::render(const Camera &C) {
  const int Degree = shDegreeAt(Run.Settings, Done, State.ShDegree);
  Renderer.divide(nullptr);
  if (Run.RandomBackground)
    Renderer.setBackground(Run.Background);
  const cl::Buffer Picture =
      Renderer.forward(State, relativeTo(C, Run.Origin), Degree);
  Launch.beginStage(Stage::ReadBack);
  Photo P{C.Width, C.Height, {}};
  const std::size_t Pixels =
      static_cast<std::size_t>(C.Width) * static_cast<std::size_t>(C.Height);
  std::vector<float> Rgba(4 * Pixels);
  Launch.read("picture", Rgba.data(), Picture, 4 * Rgba.size());
  // As a byte a NaN would be black.
  if (std::ranges::any_of(Rgba, [](float V) { return std::isnan(V); }))
    Launch.fail({"",
                 fmt::format("view {} of the trained scene has non-finite "
                             "values, expected a picture",
                             printable(C.Name)),
                 ExitCode::GuestFailed});
  P.Rgb.reserve(3 * Pixels);
  for (std::size_t I = 0; I < Pixels; ++I)
    for (std::size_t K = 0; K < 3; ++K)
      P.Rgb.push_back(toByte(Rgba[4 * I + K]));
  return P;
}

std::vector<double>
Trainer::evaluate(const std::function<void(const TrainView &, Photo)> &Take) {
  std::vector<double> Db;
  Db.reserve(Pictures.HeldOut.size());
  for (const TrainView &V : Pictures.HeldOut) {
    Photo P = render(V.Pose);
    Db.push_back(psnrOfBytes(P.Rgb, V.Picture.Rgb, V.Counts));
    if (Take)
      Take(V, std::move(P));
  }
  return Db;
}

} // namespace vorion::splat
