#include "train/run/Training.h"

#include "io/Mean.h"
#include "picture/Layout.h"
#include "picture/SceneUnit.h"
#include "picture/View.h"
#include "scene/Activation.h"
#include "train/data/Start.h"
#include "train/run/RunRecord.h"
#include "vorion/support/File.h"
#include "vorion/support/Hash.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fmt/format.h>

namespace vorion::splat {

namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

/// The signal of an interrupt; the loop then ends after the iteration at hand.
volatile std::sig_atomic_t Interrupted = 0;

void onInterrupt(int Signal) { Interrupted = Signal; }

/// As shells have it of what a signal ends. Another process may have got it.
ExitCode codeOfInterrupt() {
  constexpr int OfSignals = 128;
  return static_cast<ExitCode>(OfSignals +
                               (Interrupted != 0 ? Interrupted : SIGTERM));
}

/// What the whole run is about, once everything is read.
struct Work {
  const TrainRequest &Request;
  const TrainHost &Host;
  const Capture &Photos;
  const TrainingSet &Pictures;
  Ranks &Processes;
  Json Record;
  TrainOutcome &Out;
  /// Iterations of the checkpoint that this run replaces; 0: of none.
  unsigned Replaced = 0;
};

Expected<Success> writeState(const Work &W, Launcher &Launch, Trainer &T) {
  Checkpoint C = T.save();
  if (Launch.failure())
    return *Launch.failure();
  C.Run = jsonText(W.Record);
  return writeCheckpoint(W.Request.Checkpoint, C);
}

/// Of all processes, which have the same state, the first writes it.
Expected<Success> keep(const Work &W, Launcher &Launch, Trainer &T) {
  return W.Processes.agree(W.Processes.first() ? writeState(W, Launch, T)
                                               : Success{});
}

double secondsSince(Clock::time_point Start) {
  return std::chrono::duration<double>(Clock::now() - Start).count();
}

/// Says where random points are if most pictures do not show them, and how many
/// of the capture's are left out.
void noteStart(const Work &W) {
  const std::size_t Points = W.Photos.Points.size(),
                    Most = W.Request.Run.Settings.MostGaussians;
  if (Points > Most)
    W.Host.Note(fmt::format(
        "training starts from {} of {} points, limited by --max-gaussians",
        Most, Points));
  if (Points != 0)
    return;
  const RandomCube Cube = randomCube(W.Photos);
  if (2 * Cube.SeenBy < W.Photos.Views.size())
    W.Host.Note(fmt::format(
        "the capture has no points, and {} of {} views see {}, around which "
        "random initial points are placed (docs/captures.md)",
        Cube.SeenBy, W.Photos.Views.size(), Cube.centreText()));
}

MomentsOn placeOfMoments(const TrainRequest &R, const Device &D) {
  if (R.Moments != MomentsChoice::Auto)
    return R.Moments == MomentsChoice::Host ? MomentsOn::Host
                                            : MomentsOn::Device;
  return R.Run.Settings.MostGaussians >
                 mostInTraining(D.globalBytes(), R.ShDegree, MomentsOn::Device)
             ? MomentsOn::Host
             : MomentsOn::Device;
}

/// Says that moments stay on the host, which takes time, and that the scene may
/// outgrow the device, which ends the run, maybe hours later.
void noteRoom(const Work &W, const Device &D) {
  const auto Holds = [&](MomentsOn Where) {
    return mostInTraining(D.globalBytes(), W.Request.ShDegree, Where);
  };
  const uint64_t Most = W.Request.Run.Settings.MostGaussians;
  if (W.Request.Moments == MomentsChoice::Auto &&
      W.Out.Moments == MomentsOn::Host)
    W.Host.Note(fmt::format(
        "{} holds at most {} Gaussians of SH degree {} with Adam's moments, "
        "and --max-gaussians allows {}: the moments are stored on the host; "
        "results are bit-identical",
        D.name(), Holds(MomentsOn::Device), W.Request.ShDegree, Most));
  if (Most > Holds(W.Out.Moments))
    W.Host.Note(fmt::format(
        "{} holds at most {} Gaussians of SH degree {} in training, less the "
        "memory for pictures, and --max-gaussians allows {}: the run fails if "
        "the scene exceeds this",
        D.name(), Holds(W.Out.Moments), W.Request.ShDegree, Most));
}

/// Says once, \p Said, that most Gaussians do not learn.
void noteWithoutGradient(const Work &W, const StepReport &Step, bool &Said) {
  if (Said || !Step.Density ||
      2 * uint64_t{Step.Density->WithoutGradient} <= Step.Density->Before)
    return;
  Said = true;
  W.Host.EndProgress();
  W.Host.Note(fmt::format(
      "iteration {}: {} of {} Gaussians had no gradient since the previous "
      "step of density control: they are outside all pictures, or their alpha "
      "is below 1/255",
      Step.Iteration, Step.Density->WithoutGradient, Step.Density->Before));
}

/// What the host does between two iterations; returns the time that it took.
Clock::duration between(const Work &W, Launcher &Launch, Trainer &T,
                        const TrainProgress &Progress) {
  const Clock::time_point Begun = Clock::now();
  Launch.setProfiled(false);
  if (!W.Host.Between({Progress, W.Out, T.losses(),
                       [&T](const Camera &C) { return T.render(C); },
                       [] { return Interrupted != 0; }}))
    Interrupted = SIGINT;
  Launch.takeStages();
  return Clock::now() - Begun;
}

Expected<Success> loop(const Work &W, Launcher &Launch,
                       DeviceRenderer &Renderer, Trainer &T) {
  Clock::time_point Start = Clock::now();
  const unsigned First = W.Out.First = T.iteration();
  const unsigned Last = W.Request.Run.Settings.Iterations;
  ClockSamples &Samples = W.Out.Timed;
  bool SaidWithoutGradient = false;
  double FirstSeconds = 0;
  W.Out.Counts.emplace_back(First, T.gaussians());
  while (T.iteration() < Last && !W.Processes.any(Interrupted != 0)) {
    const bool Timed =
        W.Request.TimeEvery &&
        isTimed(W.Request.Run.Seed, *W.Request.TimeEvery, T.iteration() + 1);
    Launch.setProfiled(Timed);
    const StepReport Step = T.step(Timed);
    std::vector<StageReport> Stages = Launch.takeStages();
    if (Step.Iteration == First + 1)
      FirstSeconds = secondsSince(Start);
    if (Launch.failure()) {
      W.Host.ShowBuildLog(Launch);
      return *Launch.failure();
    }
    // All processes then end with it at the next step.
    if (Timed && !Samples.add({Step.Iteration, Step.Gaussians,
                               Renderer.listLengths(), std::move(Stages)}))
      Launch.fail({"",
                   "the device reported no kernel time, expected a runtime "
                   "that supports VORION_TIME=profiled",
                   ExitCode::Internal});
    if (W.Processes.first())
      noteWithoutGradient(W, Step, SaidWithoutGradient);
    if (Step.Gaussians != W.Out.Counts.back().second)
      W.Out.Counts.emplace_back(Step.Iteration, Step.Gaussians);
    const TrainProgress Progress{
        Step,
        First,
        Last,
        secondsSince(Start),
        FirstSeconds,
        Samples.empty() ? std::nullopt : std::optional(Samples.rate())};
    if (W.Processes.first())
      W.Host.Progress(Progress);
    if (W.Processes.first() && W.Request.ScoreEvery != 0 &&
        Step.Iteration % W.Request.ScoreEvery == 0 &&
        !W.Pictures.HeldOut.empty()) {
      Launch.setProfiled(false);
      W.Out.Scores.emplace_back(Step.Iteration, meanOf(T.evaluate()));
      Launch.takeStages();
    }
    if (W.Processes.first() && W.Host.Between)
      Start += between(W, Launch, T, Progress);
    if (Step.Iteration % W.Request.CheckpointEvery == 0 &&
        Step.Iteration != Last)
      if (auto Kept = keep(W, Launch, T); !Kept)
        return Kept;
  }
  Launch.setProfiled(false);
  if (W.Processes.first())
    W.Host.EndProgress();
  W.Out.Seconds = secondsSince(Start);
  if (T.iteration() < W.Replaced)
    return Error{W.Request.Checkpoint,
                 fmt::format("remains at iteration {}: interrupted after {} of "
                             "{} without saving",
                             W.Replaced, T.iteration(), Last),
                 codeOfInterrupt()};
  if (auto Kept = keep(W, Launch, T); !Kept)
    return Kept;
  if (T.iteration() < Last)
    return Error{W.Request.Checkpoint,
                 fmt::format("interrupted after iteration {} of {}, which is "
                             "saved; --resume continues from it",
                             T.iteration(), Last),
                 codeOfInterrupt()};
  return Success{};
}

/// That all processes are about to do the same; for the first error.
Expected<Success> checkSameStart(const Work &W, unsigned Iteration) {
  const std::string Mine =
      fmt::format("{} {:010}", fnv1a64(jsonText(W.Record)), Iteration);
  std::string First = Mine;
  W.Processes.share(0, First.data(), First.size());
  if (First == Mine)
    return W.Processes.agree(Success{});
  return W.Processes.agree(Error{
      W.Request.Capture,
      "another capture or checkpoint, expected those of the first process"});
}

/// Gives \p T the run's own checkpoint.
Expected<Success> resume(const Work &W, Trainer &T) {
  const TrainRequest &R = W.Request;
  const auto Kept = readCheckpoint(R.Checkpoint);
  if (!Kept)
    return Kept.error();
  if (auto Same = checkSameRun(R.Checkpoint, Kept->Run, W.Record); !Same)
    return Same;
  if (Kept->Iteration > R.Run.Settings.Iterations)
    return Error{
        R.Checkpoint,
        fmt::format(
            "has iteration {}, expected --iterations of at least that, not {}",
            Kept->Iteration, R.Run.Settings.Iterations),
        ExitCode::Usage};
  T.restore(*Kept);
  W.Out.ResumedAfter = T.iteration();
  if (W.Processes.first())
    W.Host.Note(fmt::format("continuing after iteration {} of {}",
                            T.iteration(), R.Checkpoint));
  return Success{};
}

/// Moves the scene of \p C from the frame with the origin \p From to that of
/// \p To.
void changeFrame(Checkpoint &C, const WorldPoint &From, const WorldPoint &To) {
  const std::size_t N = C.gaussians();
  for (std::size_t K = 0; K < 3; ++K)
    if (const double By = From[K] - To[K]; By != 0)
      for (std::size_t I = 0; I < N; ++I) {
        float &Mean = C.Geometry[(PLANE_MEAN + K) * N + I];
        Mean = static_cast<float>(Mean + By);
      }
}

/// Gives \p T another run's checkpoint, or the capture's points.
Expected<Success> begin(const Work &W, Trainer &T) {
  const TrainRequest &R = W.Request;
  const TrainSettings &S = R.Run.Settings;
  if (R.From.empty()) {
    noteStart(W);
    Scene Start =
        startingScene(W.Photos, {R.Run.Seed, R.ShDegree, S.MostGaussians,
                                 S.StartOpacity, S.StartScale});
    if (R.Run.Kind == RendererKind::Surfel)
      flatten(Start);
    T.start(Start);
    return Success{};
  }
  auto Other = readCheckpoint(R.From);
  if (!Other)
    return Other.error();
  if (auto Checked = checkBeginning(R, *Other); !Checked)
    return Checked;
  const auto Origin = originOf(R.From, Other->Run);
  if (!Origin)
    return Origin.error();
  changeFrame(*Other, *Origin, R.Run.Origin);
  T.restore(*Other);
  return Success{};
}

/// Refuses to replace a checkpoint by one that is less far, which would lose
/// what was trained, and any other file, which may be a damaged checkpoint.
Expected<Success> checkReplaced(Work &W, unsigned Begin) {
  const TrainRequest &R = W.Request;
  namespace fs = std::filesystem;
  std::error_code Ignored;
  if (!fs::is_regular_file(R.Checkpoint, Ignored) ||
      fs::is_empty(R.Checkpoint, Ignored))
    return Success{};
  const auto Kept = readCheckpoint(R.Checkpoint);
  if (!Kept)
    return Error{Kept.error().Where,
                 fmt::format("{}; it is not overwritten: use another "
                             "--checkpoint, or remove the file",
                             Kept.error().What),
                 Kept.error().Code};
  const unsigned Every = R.CheckpointEvery;
  const unsigned First =
      std::min(R.Run.Settings.Iterations, (Begin / Every + 1) * Every);
  if (Kept->Iteration > First)
    return Error{R.Checkpoint,
                 fmt::format("has iteration {}, and would be overwritten by "
                             "iteration {}, expected --resume to continue from "
                             "it, another --checkpoint, or no such file",
                             Kept->Iteration, First),
                 ExitCode::Usage};
  if (W.Processes.first() && Kept->Iteration < R.Run.Settings.Iterations)
    W.Host.Note(fmt::format("starts from scratch; {} has iteration {}, from "
                            "which --resume continues",
                            R.Checkpoint, Kept->Iteration));
  W.Replaced = Kept->Iteration;
  return Success{};
}

/// Gives \p T what it begins with: its own checkpoint or another beginning.
Expected<Success> start(Work &W, Trainer &T) {
  const TrainRequest &R = W.Request;
  if (R.Resume && std::filesystem::exists(R.Checkpoint))
    return resume(W, T);
  if (R.Resume && W.Processes.first())
    W.Host.Note(fmt::format("starts from scratch; there is no {} from which "
                            "--resume could continue",
                            R.Checkpoint));
  if (auto Begun = begin(W, T); !Begun)
    return Begun;
  return checkReplaced(W, T.iteration());
}

/// Finds out what the request leaves open: the cameras' extent, the near plane,
/// and hashes of what the run begins with.
Expected<Success> complete(TrainRequest &R, const Capture &C) {
  R.Run.Extent = sceneExtent(C);
  if (!(R.Run.Extent > 0))
    return Error{R.Capture, "all training cameras have the same position, "
                            "expected cameras around the scene"};
  if (!R.Run.Near)
    R.Run.Near = nearOfSmallScene(R.Convention, C.poses(), sampleOf(C));
  R.Run.Origin = C.Points.Origin;
  if (R.From.empty()) {
    R.Run.Points = hashPoints(C.Points);
    return Success{};
  }
  auto Hash = fnv1a64OfFile(R.From);
  if (!Hash)
    return Hash.error();
  R.Run.From = *Hash;
  return Success{};
}

/// What is measured at the end, in the first process.
Expected<Success> finish(const Work &W, const Device &D, Launcher &Launch,
                         Trainer &T) {
  TrainOutcome &Out = W.Out;
  Out.Result = T.scene();
  if (W.Request.Run.Kind == RendererKind::Surfel)
    flatten(Out.Result); // training moved what stands for no scale
  const std::vector<double> Db =
      T.evaluate([&](const TrainView &V, Photo Drawn) {
        if (W.Request.KeepPictures)
          Out.Shown.emplace_back(std::move(Drawn), V);
      });
  if (Launch.failure())
    return *Launch.failure();
  for (std::size_t I = 0; I < Db.size(); ++I)
    Out.HeldOut.emplace_back(W.Pictures.HeldOut[I].Pose.Name, Db[I]);
  for (const TrainView &V : W.Pictures.HeldOut)
    Out.Cameras.push_back(V.Pose);
  for (std::size_t I = 0; I < W.Pictures.Training.size(); ++I)
    Out.Cameras.push_back(T.pose(I));
  if (arePosesOn(W.Request.Run.Settings))
    Out.Poses = T.poseChange();
  Out.Record = W.Record;
  Out.Near = W.Request.Run.Near;
  Out.DeviceName = D.name();
  Out.DeviceVersion = D.version();
  const Camera &First = W.Pictures.Training.front().Pose;
  Out.Width = First.Width;
  Out.Height = First.Height;
  Out.TrainingViews = W.Pictures.Training.size();
  Out.HeldOutBy = W.Photos.HeldOutBy;
  Out.WithoutPicture = W.Photos.WithoutPicture;
  Out.Notes = W.Photos.Notes;
  Out.Distorted = W.Photos.distorted();
  Out.Masked = W.Photos.masked();
  Out.Depths = W.Pictures.depths();
  Out.Processes = W.Processes.size();
  Out.Iterations = T.iteration();
  Out.Losses = T.losses();
  Out.Without = baselinesOf(W.Pictures);
  return Success{};
}

ViewFacts factsOfCameras(const std::vector<Camera> &Cameras) {
  ViewFacts All = factsOfCamera(makeView(Cameras.front(), {}));
  for (const Camera &C : Cameras)
    All = combined(All, factsOfCamera(makeView(C, {})));
  return All;
}

/// \p Ready becomes true once every process has come as far as to train.
Expected<Success> trainHere(TrainRequest &R, const TrainHost &Host,
                            Ranks &Processes, bool &Ready, TrainOutcome &Out) {
  if (auto Checked = Host.Check(); !Checked)
    return Checked;
  if (Processes.size() != 1 && R.Backward.Pixels != SimtSums::Ordered)
    return Error{
        "",
        fmt::format("--simt-sums {}: {} processes divide the tiles of a "
                    "picture, expected --simt-sums ordered, or one "
                    "process",
                    name(R.Backward.Pixels), Processes.size()),
        ExitCode::Usage};
  const auto C = readCapture(R.Capture, R.Read);
  if (!C)
    return C.error();
  if (auto Completed = complete(R, *C); !Completed)
    return Completed;
  const auto Pictures = loadTrainingSet(
      *C, {R.Downscale, R.Run.Background, R.Run.Masks, R.Run.RandomBackground,
           looksAtDepths(R.Run.Settings), R.Run.Pictures});
  if (!Pictures)
    return Pictures.error();
  const std::vector<Camera> Cameras = Pictures->cameras();
  const auto Model = commonModel(R.Capture, Cameras);
  if (!Model)
    return Model.error();
  if (looksAtDepths(R.Run.Settings) && Pictures->depths() == 0)
    return Error{R.Capture,
                 "no training picture observes a point of the capture, "
                 "expected COLMAP's points with tracks for --depth-weight"};
  const PictureSource Source{std::string(name(C->Format)), R.Downscale};
  Work W{R,
         Host,
         *C,
         *Pictures,
         Processes,
         runRecord(R.Run, *Pictures, Source, R.ShDegree, R.Convention,
                   R.Blending, R.Backward),
         Out};
  const auto D = Host.OpenDevice();
  if (!D)
    return D.error();
  Launcher Launch(*D, "", {});
  Launch.setRemedy(
      "a smaller --max-gaussians, or smaller pictures (--downscale)");
  Out.Moments = placeOfMoments(R, *D);
  if (Processes.first())
    noteRoom(W, *D);
  Launch.beginStage(Stage::Build);
  for (const ProgramSpec &P :
       Trainer::programs(R.Run.Settings, *Pictures, Out.Moments, R.Run.Kind))
    Launch.build(P);
  DeviceRenderer Renderer(
      Launch, R.Convention, R.Blending, R.Backward,
      {R.Run.Background, R.Run.RandomBackground, R.Run.Antialiased, R.Run.Near,
       *Model, isRolling(Cameras), R.Run.Through, R.Run.Kind,
       R.Run.FalloffDegree, factsOfCameras(relativeTo(Cameras, R.Run.Origin))});
  Trainer T(Launch, Renderer, *Pictures, R.Run, Processes, Out.Moments);
  if (auto Started = start(W, T); !Started)
    return Started;
  if (Launch.failure()) {
    Host.ShowBuildLog(Launch);
    return *Launch.failure();
  }
  if (Processes.first() && Host.Begin)
    if (auto Begun = Host.Begin(*Pictures); !Begun)
      return Begun;
  Ready = true;
  if (auto All = Processes.agree(Success{}); !All)
    return All;
  if (auto Same = checkSameStart(W, T.iteration()); !Same)
    return Same;
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  if (auto Done = loop(W, Launch, Renderer, T); !Done)
    return Done;
  return Processes.first() ? finish(W, *D, Launch, T) : Success{};
}

} // namespace

Expected<Success> checkBeginning(const TrainRequest &R, const Checkpoint &C) {
  if (C.ShDegree != R.ShDegree ||
      C.gaussians() > R.Run.Settings.MostGaussians ||
      C.Iteration >= R.Run.Settings.Iterations)
    return Error{R.From,
                 fmt::format("{} of SH degree {} after iteration {}, "
                             "expected at most {} of degree {} and less than "
                             "{} iterations",
                             counted(C.gaussians(), "Gaussian"), C.ShDegree,
                             C.Iteration, R.Run.Settings.MostGaussians,
                             R.ShDegree, R.Run.Settings.Iterations),
                 ExitCode::Usage};
  return Success{};
}

double TrainOutcome::meanDb() const {
  std::vector<double> Db;
  Db.reserve(HeldOut.size());
  for (const auto &[Name, Value] : HeldOut)
    Db.push_back(Value);
  return meanOf(Db);
}

Expected<std::optional<TrainOutcome>> train(TrainRequest R,
                                            const TrainHost &Host) {
  const auto Processes = openRanks();
  if (!Processes)
    return Processes.error();
  bool Ready = false;
  TrainOutcome Out;
  const auto Done = trainHere(R, Host, **Processes, Ready, Out);
  const auto All = Ready ? Done : (*Processes)->agree(Done);
  // mpirun ends everything at the first exit code that is not 0: that must be
  // the process's that says why.
  if (!(*Processes)->first())
    return std::optional<TrainOutcome>();
  if (!All)
    return All.error();
  return std::optional(std::move(Out));
}

} // namespace vorion::splat
