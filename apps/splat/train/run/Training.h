/// A complete training run: capture, processes, checkpoints, interrupts, loop.
#pragma once

#include "capture/Capture.h"
#include "train/data/Baselines.h"
#include "train/optimize/DeviceRenderer.h"
#include "train/run/Checkpoint.h"
#include "train/run/ClockSamples.h"
#include "train/run/Trainer.h"

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::splat {

/// The memory of Adam's moments. Auto: the host if the device cannot hold the
/// maximum number of Gaussians with their moments.
enum class MomentsChoice { Auto, Device, Host };

constexpr std::string_view name(MomentsChoice C) {
  return C == MomentsChoice::Auto
             ? "auto"
             : name(C == MomentsChoice::Host ? MomentsOn::Host
                                             : MomentsOn::Device);
}

/// The parameters of a run and its outputs.
struct TrainRequest {
  std::string Capture;
  CaptureOptions Read;
  int Downscale = 1;
  int ShDegree = MaxShDegree;
  Rules Convention = Rules::Inria;
  Blender Blending = Path::Raster;
  BackwardOptions Backward;
  TrainRun Run; ///< extent and hashes are computed
  MomentsChoice Moments = MomentsChoice::Auto; ///< changes no bit
  std::string Checkpoint;
  unsigned CheckpointEvery = 1000; ///< iterations
  bool Resume = false; ///< continue from the checkpoint if it exists
  std::string From;    ///< checkpoint of another run, or empty
  /// One of this number of iterations is timed by the clock; empty: none.
  std::optional<unsigned> TimeEvery;
  /// Iterations between evaluations of the held-out views; 0: only the last.
  unsigned ScoreEvery = 0;
  bool KeepPictures = false; ///< keep held-out pictures in the outcome
};

/// The progress of a run.
struct TrainProgress {
  StepReport Step;
  unsigned First = 0, Last = 0; ///< iterations done before, and in total
  double Seconds = 0;           ///< wall time
  /// Time of the first iteration, which includes compilation of kernels.
  double FirstSeconds = 0;
  /// Simulated iterations per second, once an iteration has been timed.
  std::optional<double> MachineRate;
};

struct TrainOutcome;

/// A run between two iterations.
struct TrainMoment {
  const TrainProgress &Progress;
  const TrainOutcome &SoFar; ///< its Counts, Scores and Timed
  const std::vector<float> &Losses;
  /// Renders the scene as it is, rounded to 8 bits. The camera must have the
  /// size and the lens of one of the run's.
  std::function<Photo(const Camera &)> Render;
  std::function<bool()> IsInterrupted;
};

/// Callbacks of a run. Each process that mpirun started has its own.
struct TrainHost {
  /// Checks all other options; called first.
  std::function<Expected<Success>()> Check;
  std::function<Expected<Device>()> OpenDevice;
  /// Prints the build log if programs failed to compile.
  std::function<void(const Launcher &)> ShowBuildLog;

  /// \name Only in the first process
  /// @{
  std::function<void(const TrainProgress &)> Progress; ///< called for each
                                                       ///< iteration
  std::function<void()> EndProgress;
  std::function<void(std::string_view)> Note; ///< prints a line
  /// May be empty. Called once before the first iteration.
  std::function<Expected<Success>(const TrainingSet &)> Begin;
  /// May be empty. Called after each iteration. Its time is not that of the
  /// run. If the result is false, the run ends as by SIGINT.
  std::function<bool(const TrainMoment &)> Between;
  /// @}
};

/// The result of a run.
struct TrainOutcome {
  Scene Result;
  nlohmann::ordered_json Record; ///< parameters of the run (RunRecord.h)
  std::string DeviceName, DeviceVersion;
  int Width = 0, Height = 0; ///< px, of the first training view
  std::size_t TrainingViews = 0;
  std::string HeldOutBy; ///< criterion for held-out views
  /// Number of views without a picture; with distortion; with a mask.
  std::size_t WithoutPicture = 0, Distorted = 0, Masked = 0;
  std::vector<std::string> Notes; ///< of the capture
  std::size_t Depths = 0; ///< number of pixels of training pictures with a
                          ///< known depth
  std::optional<PoseChange> Poses; ///< if poses were corrected
  std::optional<float> Near; ///< depth of the near plane, if not the rules' own
  MomentsOn Moments = MomentsOn::Device;
  unsigned Processes = 1;
  unsigned First = 0, Iterations = 0; ///< done before, and in total
  unsigned ResumedAfter = 0; ///< iteration of its own checkpoint; 0: not
                             ///< resumed
  double Seconds = 0;        ///< wall time of the loop
  ClockSamples Timed;
  std::vector<float> Losses; ///< of every iteration
  /// Iterations from which on there was another number of Gaussians, and that
  /// number; from First on.
  std::vector<std::pair<unsigned, uint32_t>> Counts;
  /// Iterations, and the held-out views' mean PSNR after them.
  std::vector<std::pair<unsigned, double>> Scores;
  /// Names of the held-out views, and the PSNR of their 8-bit values.
  std::vector<std::pair<std::string, double>> HeldOut;
  std::optional<Baselines> Without; ///< if views are held out
  std::vector<Camera> Cameras;      ///< of all views, at their size in training
  /// Rendered and true pictures of held-out views, if requested.
  std::vector<std::pair<Photo, TrainView>> Shown;

  /// Mean PSNR over the held-out views, of which there must be at least one.
  double meanDb() const;
};

/// Checks that the run \p R can start from \p C, the checkpoint of its --from.
Expected<Success> checkBeginning(const TrainRequest &R, const Checkpoint &C);

/// Executes the run \p R. An interrupt (SIGINT, SIGTERM) ends the run after the
/// current iteration, with a checkpoint and an Error. Only the first process
/// returns an outcome or an Error; the others return nothing.
Expected<std::optional<TrainOutcome>> train(TrainRequest R,
                                            const TrainHost &Host);

} // namespace vorion::splat
