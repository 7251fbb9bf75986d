#include "CaptureInfo.h"
#include "Choices.h"
#include "Commands.h"
#include "DeviceArguments.h"
#include "OutputFile.h"
#include "PictureOptions.h"

#include "../analyze/Chart.h"
#include "../capture/Capture.h"
#include "../io/Hash.h"
#include "../io/Mean.h"
#include "../scene/formats/Ply.h"
#include "../train/Baselines.h"
#include "../train/ClockSamples.h"
#include "../train/DeviceRenderer.h"
#include "../train/RunRecord.h"
#include "../train/Start.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <unistd.h>

namespace vorion::splat {

namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

struct TrainArguments {
  std::string Capture, Output, Json, Curve, Checkpoint, From, Device;
  std::vector<std::string> Exclude;
  std::array<float, 3> Background{0, 0, 0};
  int Downscale = 1, ShDegree = MaxShDegree;
  unsigned CheckpointEvery = 1000;
  bool Resume = false, Time = false, Breakdown = false;
  bool AllowOutside = false;
  std::optional<unsigned> GivenTimeEvery;
  unsigned ScoreEvery = 0;
  Rules Convention = Rules::Inria;
  Path Blending = Path::Raster;
  unsigned SimtTile = Blender(Path::Simt).SimtTile;
  unsigned SimtGroup = Blender(Path::Simt).SimtGroup;
  BackwardOptions Backward;
  TrainRun Run;

  bool isClocked() const { return Time || Breakdown; }
  unsigned timeEvery() const { return GivenTimeEvery.value_or(50); }
  Blender blender() const { return {Blending, SimtTile, SimtGroup}; }
};

/// Set by an interrupt; the loop then ends after the iteration at hand.
volatile std::sig_atomic_t Interrupted = 0;

void onInterrupt(int /*Signal*/) { Interrupted = 1; }

/// What the whole run is about, once everything is read.
struct Work {
  Work(const TrainArguments &Arguments, const Capture &From,
       const TrainingSet &Set, Ranks &Processes)
      : A(Arguments), C(From), Pictures(Set), Together(Processes) {}

  const TrainArguments &A;
  const Capture &C;
  const TrainingSet &Pictures;
  Ranks &Together;
  Json Run; ///< as checkpoints have it
  double Seconds = 0;
  unsigned First = 0; ///< iterations that were done before
  ClockSamples Timed;
  /// Iterations, and the held-out views' PSNR after them.
  std::vector<std::pair<unsigned, double>> Scores;
};

/// One line that says how far the run is; on a terminal it is overwritten.
void showProgress(const Work &W, const StepReport &R, Clock::time_point Start) {
  const bool Terminal = isatty(STDERR_FILENO) != 0;
  constexpr unsigned Every = 50;
  if (!W.Together.first() ||
      (!Terminal && R.Iteration % Every != 0 && R.Iteration != 1))
    return;
  const double Seconds =
      std::chrono::duration<double>(Clock::now() - Start).count();
  const std::string Line = fmt::format(
      "{}iteration {}/{}: loss {:.5f}, {} Gaussians, {:.2f} it/s of wall "
      "time{}{}",
      Terminal ? "\r\033[K" : "", R.Iteration, W.A.Run.Settings.Iterations,
      R.Loss.Value, R.Gaussians, (R.Iteration - W.First) / Seconds,
      W.Timed.empty()
          ? ""
          : fmt::format(", {:.3f} of the machine's clock", W.Timed.rate()),
      Terminal ? "" : "\n");
  // Not printNote(), which would escape what clears the line.
  std::fputs(Line.c_str(), stderr);
}

Expected<Success> writeState(const Work &W, Launcher &L, Trainer &T) {
  Checkpoint C = T.save();
  if (L.failure())
    return *L.failure();
  C.Run = jsonText(W.Run);
  return writeCheckpoint(W.A.Checkpoint, C);
}

/// Of all processes, which have the same state, the first writes it.
Expected<Success> keep(const Work &W, Launcher &L, Trainer &T) {
  return W.Together.agree(W.Together.first() ? writeState(W, L, T) : Success{});
}

Expected<Success> loop(Work &W, Launcher &L, DeviceRenderer &Renderer,
                       Trainer &T) {
  const Clock::time_point Start = Clock::now();
  W.First = T.iteration();
  const unsigned Last = W.A.Run.Settings.Iterations;
  while (T.iteration() < Last && !W.Together.any(Interrupted != 0)) {
    const bool Timed = W.A.isClocked() && isTimed(W.A.Run.Seed, W.A.timeEvery(),
                                                  T.iteration() + 1);
    L.setProfiled(Timed);
    const StepReport R = T.step();
    std::vector<StageReport> Stages = L.takeStages();
    if (L.failure()) {
      showBuildLog(L);
      return *L.failure();
    }
    // All processes then end with it at the next step.
    if (Timed && !W.Timed.add({R.Iteration, R.Gaussians, Renderer.listLengths(),
                               std::move(Stages)}))
      L.fail({"",
              "the device gave no time of a kernel, expected a runtime that "
              "knows VORION_TIME=profiled",
              ExitCode::Internal});
    showProgress(W, R, Start);
    if (W.Together.first() && W.A.ScoreEvery != 0 &&
        R.Iteration % W.A.ScoreEvery == 0 && !W.Pictures.HeldOut.empty()) {
      L.setProfiled(false);
      W.Scores.emplace_back(R.Iteration, meanOf(T.evaluate()));
      L.takeStages();
    }
    if (R.Iteration % W.A.CheckpointEvery == 0 && R.Iteration != Last)
      if (auto Kept = keep(W, L, T); !Kept)
        return Kept;
  }
  L.setProfiled(false);
  if (W.Together.first() && isatty(STDERR_FILENO) != 0)
    printNote("\n");
  W.Seconds = std::chrono::duration<double>(Clock::now() - Start).count();
  if (auto Kept = keep(W, L, T); !Kept)
    return Kept;
  if (T.iteration() < Last)
    return Error{W.A.Checkpoint,
                 fmt::format("interrupted after iteration {} of {}, which is "
                             "kept; --resume goes on",
                             T.iteration(), Last),
                 ExitCode::LimitReached};
  return Success{};
}

std::string jsonReport(const Work &W, const Device &D, Trainer &T,
                       const std::vector<double> &Db,
                       const std::optional<Baselines> &B) {
  Json Views = Json::array();
  for (std::size_t I = 0; I < Db.size(); ++I)
    Views.push_back(
        {{"name", W.Pictures.HeldOut[I].Pose.Name}, {"psnr8_db", Db[I]}});
  Json Scores = Json::array();
  for (const auto &[Iteration, Psnr] : W.Scores)
    Scores.push_back({{"iteration", Iteration}, {"psnr8_db", Psnr}});
  const Camera &First = W.Pictures.Training.front().Pose;
  const Json Report{
      {"program", {{"name", "splat"}, {"version", VORION_VERSION}}},
      {"device", {{"name", D.name()}, {"version", D.version()}}},
      {"capture", W.A.Capture},
      {"resolution", {First.Width, First.Height}},
      {"run", W.Run},
      {"picture_filter", PhotoFilter},
      {"held_out_by", W.C.HeldOutBy},
      {"rules", name(W.A.Convention)},
      {"support", name(Support::Exact)},
      {"iterations", T.iteration()},
      {"gaussians", T.gaussians()},
      {"seconds", W.Seconds},
      {"iterations_timed", T.iteration() - W.First},
      {"timed", W.Timed.json()},
      {"psnr8_db", Db.empty() ? Json() : Json(meanOf(Db))},
      {"scores", Scores},
      {"views", Views},
      {"baselines_db", B ? Json{{"constant", B->Constant},
                                {"mean_picture", B->Mean},
                                {"best_training_view", B->BestView}}
                         : Json()},
      {"losses", T.losses()}};
  return jsonText(Report, 2) + "\n";
}

/// The losses in so many parts of the run, as means.
std::string curveOf(const Trainer &T, const std::string &What) {
  const std::vector<float> &Losses = T.losses();
  const std::size_t Parts = std::min<std::size_t>(50, Losses.size());
  Chart C{"Loss in training, " + What, "iteration", "loss", {}, 10, {}, false};
  ChartSeries Means{"mean of a part", {}};
  for (std::size_t P = 0; P < Parts; ++P) {
    const auto Begin = static_cast<std::ptrdiff_t>(P * Losses.size() / Parts);
    const auto End =
        static_cast<std::ptrdiff_t>((P + 1) * Losses.size() / Parts);
    C.Places.push_back(std::to_string(Begin + 1));
    Means.Values.push_back(
        std::accumulate(Losses.begin() + Begin, Losses.begin() + End, 0.0) /
        static_cast<double>(End - Begin));
  }
  C.Series.push_back(std::move(Means));
  return svgOf(C);
}

Expected<Success> finish(const Work &W, const Device &D, Launcher &L,
                         Trainer &T) {
  if (!W.Together.first())
    return Success{};
  const Scene S = T.scene();
  const std::vector<double> Db = T.evaluate();
  if (L.failure())
    return *L.failure();
  if (auto Written = writePly(W.A.Output, S); !Written)
    return Written;
  if (!W.A.Curve.empty())
    if (auto Written = writeFileAtomically(
            W.A.Curve,
            curveOf(T, std::filesystem::path(W.A.Capture).filename().string()));
        !Written)
      return Written;
  const std::optional<Baselines> B = baselinesOf(W.Pictures);
  if (!W.A.Json.empty())
    if (auto Written =
            writeFileAtomically(W.A.Json, jsonReport(W, D, T, Db, B));
        !Written)
      return Written;
  printOut("{}: {} Gaussians after {} iterations\n", escaped(W.A.Output),
           S.size(), T.iteration());
  printOut("pictures     {} to train on, {} held out ({}); {}\n",
           W.Pictures.Training.size(), W.Pictures.HeldOut.size(), W.C.HeldOutBy,
           PhotoFilter);
  if (W.A.Run.Batch != 1 || W.Together.size() != 1)
    printOut("views        {} an iteration, on {} devices\n", W.A.Run.Batch,
             W.Together.size());
  printOut("rules        {}, support exact, path {}{}, opacity rate {}\n",
           name(W.A.Convention), name(W.A.Blending),
           toString(W.A.Backward, W.A.Blending), W.A.Run.Settings.OpacityRate);
  if (T.iteration() > W.First)
    printOut("wall time    {:.1f} s, {:.3f} it/s\n", W.Seconds,
             (T.iteration() - W.First) / W.Seconds);
  if (!W.Timed.empty())
    printOut("machine time {}\n", W.Timed.text());
  else if (W.A.isClocked())
    printOut("machine time unknown: of iterations {} to {} none was timed, "
             "expected a smaller --time-every than {}\n",
             W.First + 1, T.iteration(), W.A.timeEvery());
  if (B)
    printOut("held out     {:.3f} dB (PSNR of 8-bit values, mean of views)\n"
             "without it   constant {:.3f} dB, mean picture {:.3f} dB, best "
             "training view {:.3f} dB\n",
             meanOf(Db), B->Constant, B->Mean, B->BestView);
  else
    printOut("held out     no held-out views\n");
  if (W.A.Breakdown && !W.Timed.empty())
    printOut("{}", W.Timed.lastByStage());
  return Success{};
}

Expected<Success> check(const TrainArguments &A) {
  for (const auto &Checked :
       {checkEnding("-o", A.Output, {".ply"}),
        checkEnding("--curve", A.Curve, {".svg"}), checkJsonName(A.Json)})
    if (!Checked)
      return Checked;
  if (auto Checked = checkBackwardOptions(A.Backward, A.Blending); !Checked)
    return Checked;
  if (A.GivenTimeEvery && !A.isClocked())
    return Error{"", "--time-every: expected --time or --breakdown with it",
                 ExitCode::Usage};
  if (A.ScoreEvery != 0 && A.Json.empty())
    return Error{"", "--score-every: expected --json with it", ExitCode::Usage};
  for (const float V : A.Background)
    if (!(V >= 0 && V <= 1))
      return Error{"",
                   fmt::format("--background {}: expected values of 0 to 1", V),
                   ExitCode::Usage};
  return claimOutputs({{"-o", A.Output},
                       {"--json", A.Json},
                       {"--curve", A.Curve},
                       {"--checkpoint", A.Checkpoint}},
                      {{"--from", A.From}});
}

/// That all processes are about to do the same; for the first error.
Expected<Success> checkSameStart(const Work &W, unsigned Iteration) {
  const std::string Mine =
      fmt::format("{} {:010}", fnv1a64(jsonText(W.Run)), Iteration);
  std::string First = Mine;
  W.Together.share(0, First.data(), First.size());
  if (First == Mine)
    return W.Together.agree(Success{});
  return W.Together.agree(Error{
      W.A.Capture, "another capture or checkpoint, expected those of the first "
                   "process"});
}

/// Gives \p T what it begins with: its own checkpoint, another run's, or the
/// capture's points.
Expected<Success> start(const TrainArguments &A, const Work &W, Trainer &T) {
  const TrainSettings &S = A.Run.Settings;
  if (A.Resume && std::filesystem::exists(A.Checkpoint)) {
    const auto Kept = readCheckpoint(A.Checkpoint);
    if (!Kept)
      return Kept.error();
    if (auto Same = checkSameRun(A.Checkpoint, Kept->Run, W.Run); !Same)
      return Same;
    if (Kept->Iteration > S.Iterations)
      return Error{A.Checkpoint,
                   fmt::format("after iteration {} already, expected "
                               "--iterations of at least that, not {}",
                               Kept->Iteration, S.Iterations),
                   ExitCode::Usage};
    T.restore(*Kept);
    if (W.Together.first())
      printNote(fmt::format("going on after iteration {} of {}\n",
                            T.iteration(), A.Checkpoint));
    return Success{};
  }
  if (A.From.empty()) {
    T.start(startingScene(W.C, {A.Run.Seed, A.ShDegree, S.MostGaussians}));
    return Success{};
  }
  const auto Other = readCheckpoint(A.From);
  if (!Other)
    return Other.error();
  if (Other->ShDegree != A.ShDegree || Other->gaussians() > S.MostGaussians ||
      Other->Iteration >= S.Iterations)
    return Error{A.From,
                 fmt::format("{} Gaussians of SH degree {} after iteration {}, "
                             "expected at most {} of degree {} and less than "
                             "{} iterations",
                             Other->gaussians(), Other->ShDegree,
                             Other->Iteration, S.MostGaussians, A.ShDegree,
                             S.Iterations),
                 ExitCode::Usage};
  T.restore(*Other);
  return Success{};
}

/// \p Ready becomes true once every process has come as far as to train.
Expected<Success> runOne(TrainArguments &A, Ranks &Together, bool &Ready) {
  if (auto Checked = check(A); !Checked)
    return Checked;
  const auto C = readCapture(A.Capture, {A.Exclude, A.AllowOutside});
  if (!C)
    return C.error();
  A.Run.Extent = cameraRing(*C).extent();
  if (!(A.Run.Extent > 0))
    return Error{A.Capture, "all training cameras are at one place, expected "
                            "them around the scene"};
  A.Run.WhiteBackground = A.Background == std::array<float, 3>{1, 1, 1};
  if (A.From.empty()) {
    A.Run.Points = hashPoints(C->Points);
  } else {
    auto Hash = hashFile(A.From);
    if (!Hash)
      return Hash.error();
    A.Run.From = *Hash;
  }
  const auto Pictures = loadTrainingSet(*C, A.Downscale, A.Background);
  if (!Pictures)
    return Pictures.error();
  const PictureSource Source{std::string(name(C->Format)), A.Downscale,
                             A.Background};
  Work W(A, *C, *Pictures, Together);
  W.Run = runRecord(A.Run, *Pictures, Source, A.ShDegree, A.Convention,
                    A.blender(), A.Backward);

  if (A.isClocked())
    turnClockOn("profiled");
  auto D = openDevice(A.Device, A.Blending);
  if (!D)
    return D.error();
  if (A.isClocked() && !D->isVorion())
    return Error{"",
                 fmt::format("{} has no clock for --time and --breakdown, "
                             "expected a Vorion device",
                             D->name()),
                 ExitCode::Usage};
  Launcher L(*D, "", {});
  L.beginStage(Stage::Build);
  for (const ProgramSpec &P : Trainer::programs())
    L.build(P);
  DeviceRenderer Renderer(L, A.Convention, A.blender(), A.Backward,
                          A.Background);
  Trainer T(L, Renderer, *Pictures, A.Run, Together);
  if (auto Started = start(A, W, T); !Started)
    return Started;
  if (L.failure()) {
    showBuildLog(L);
    return *L.failure();
  }
  Ready = true;
  if (auto All = Together.agree(Success{}); !All)
    return All;
  if (auto Same = checkSameStart(W, T.iteration()); !Same)
    return Same;
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  if (auto Done = loop(W, L, Renderer, T); !Done)
    return Done;
  return finish(W, *D, L, T);
}

Expected<Success> run(TrainArguments &A) {
  const auto Together = openRanks();
  if (!Together)
    return Together.error();
  bool Ready = false;
  const auto Done = runOne(A, **Together, Ready);
  const auto All = Ready ? Done : (*Together)->agree(Done);
  // mpirun ends everything at the first exit code that is not 0: that must be
  // the process's that says why.
  return (*Together)->first() ? All : Success{};
}

} // namespace

Runner addTrain(CLI::App &App) {
  auto A = std::make_shared<TrainArguments>();
  TrainSettings &S = A->Run.Settings;
  App.add_option("capture", A->Capture,
                 "Photographs with poses: COLMAP, NeRF-synthetic, "
                 "transforms.json")
      ->required();
  App.add_option("-o,--output", A->Output, "Scene: INRIA's PLY")->required();
  App.add_option("--iterations", S.Iterations,
                 fmt::format("Iterations in all (default {})", S.Iterations))
      ->check(isIterations());
  App.add_option("--downscale", A->Downscale,
                 "Pictures so many times smaller (default 1)")
      ->check(CLI::Range(1, 64));
  App.add_option("--max-gaussians", S.MostGaussians,
                 fmt::format("No more Gaussians than this (default {})",
                             S.MostGaussians))
      ->check(CLI::Range(4U, 100000000U));
  App.add_option("--exclude", A->Exclude, "Leave out this picture")
      ->allow_extra_args(false);
  addOutsideOption(App, A->AllowOutside);
  App.add_option("--batch", A->Run.Batch,
                 "Views an iteration, shared out to the processes that mpirun "
                 "started, each with a device of its own (default 1)")
      ->check(CLI::Range(1U, 4096U));
  App.add_option("--seed", A->Run.Seed, "Of all random numbers (default 0)");
  App.add_option("--sh-degree", A->ShDegree,
                 "Bands of spherical harmonics (default 3)")
      ->check(CLI::Range(0, MaxShDegree));
  addBackgroundOption(App, A->Background,
                      "Colour r,g,b behind the scene and under transparent "
                      "pixels (default 0,0,0)");
  addRulesOption(App, A->Convention);
  addPathOption(App, A->Blending,
                "Who blends and goes back: the rasterizer or the cores");
  addSimtOptions(App, A->SimtTile, A->SimtGroup, SimtTilesBack);
  addBackwardOptions(App, A->Backward);
  App.add_option("--checkpoint", A->Checkpoint,
                 "Where the run is kept (default: the output's name and "
                 ".checkpoint)");
  App.add_option("--checkpoint-every", A->CheckpointEvery,
                 "Iterations from one to the next (default 1000)")
      ->check(isIterations());
  App.add_flag("--resume", A->Resume,
               "Go on from the checkpoint, if there is one");
  App.add_option("--from", A->From,
                 "Begin with the scene, the moments and the iteration of "
                 "another run's checkpoint");
  App.add_flag("--time", A->Time,
               "Say how long iterations take on the machine (docs/model.md)");
  App.add_flag("--breakdown", A->Breakdown,
               "The same, with the last one that is timed by stage");
  App.add_option("--time-every", A->GivenTimeEvery,
                 "Of so many iterations one is timed, drawn at random from the "
                 "seed (default 50)")
      ->check(isIterations());
  App.add_option("--score-every", A->ScoreEvery,
                 "Score the held-out views after every so many iterations, "
                 "for --json (default: at the end alone)");
  App.add_option("--json", A->Json, "Write what was done, and its losses");
  App.add_option("--curve", A->Curve, "Draw the losses (.svg)");
  addDeviceOption(App, A->Device);
  return [A] {
    if (A->Checkpoint.empty())
      A->Checkpoint = A->Output + ".checkpoint";
    return run(*A);
  };
}

} // namespace vorion::splat
