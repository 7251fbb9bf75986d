/// A whole run of training: capture, processes, checkpoints, interrupts, loop.
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

/// Where Adam's moments shall lie. Auto: on the host if the device does not
/// hold as many Gaussians as are allowed with theirs.
enum class MomentsChoice { Auto, Device, Host };

constexpr std::string_view name(MomentsChoice C) {
  return C == MomentsChoice::Auto
             ? "auto"
             : name(C == MomentsChoice::Host ? MomentsOn::Host
                                             : MomentsOn::Device);
}

/// What is asked for.
struct TrainRequest {
  std::string Capture;
  CaptureOptions Read;
  int Downscale = 1;
  int ShDegree = MaxShDegree;
  Rules Convention = Rules::Inria;
  Blender Blending = Path::Raster;
  BackwardOptions Backward;
  TrainRun Run; ///< extent and hashes are found out
  MomentsChoice Moments = MomentsChoice::Auto; ///< changes no bit
  std::string Checkpoint;
  unsigned CheckpointEvery = 1000; ///< iterations
  bool Resume = false; ///< go on from the checkpoint, if there is one
  std::string From;    ///< another run's checkpoint, or empty
  /// Of so many iterations one is timed by the machine's clock; nothing: none.
  std::optional<unsigned> TimeEvery;
  /// Iterations from one score of the held-out views to the next; 0: none but
  /// the last.
  unsigned ScoreEvery = 0;
  bool KeepPictures = false; ///< of the held-out views, for the outcome
};

/// How far a run is.
struct TrainProgress {
  StepReport Step;
  unsigned First = 0, Last = 0; ///< iterations done before, and in all
  double Seconds = 0;           ///< wall time
  /// Of the first iteration of this run, which waits for kernels to be
  /// compiled.
  double FirstSeconds = 0;
  /// Iterations a second by the machine's clock, once it has timed one.
  std::optional<double> MachineRate;
};

/// What the program around a run does for it. Processes that mpirun started
/// each have their own.
struct TrainHost {
  /// That all other options are right; the first that is called.
  std::function<Expected<Success>()> Check;
  std::function<Expected<Device>()> OpenDevice;
  /// What the compiler said, where programs did not build.
  std::function<void(const Launcher &)> ShowBuildLog;

  /// \name In the first process alone
  /// @{
  std::function<void(const TrainProgress &)> Progress; ///< of each iteration
  std::function<void()> EndProgress;
  std::function<void(std::string_view)> Note; ///< a line
  /// @}
};

/// What came out.
struct TrainOutcome {
  Scene Result;
  nlohmann::ordered_json Record; ///< what was asked (RunRecord.h)
  std::string DeviceName, DeviceVersion;
  int Width = 0, Height = 0; ///< px, of the first training view
  std::size_t TrainingViews = 0;
  std::string HeldOutBy; ///< what decided which views are held out
  /// Views of the capture that had no picture; whose lens bends; with a mask.
  std::size_t WithoutPicture = 0, Distorted = 0, Masked = 0;
  std::size_t Depths = 0; ///< places of training pictures with a known depth
  std::optional<PoseChange> Poses; ///< where poses were corrected
  MomentsOn Moments = MomentsOn::Device;
  unsigned Processes = 1;
  unsigned First = 0, Iterations = 0; ///< done before, and in all
  unsigned ResumedAfter = 0; ///< the own checkpoint's iteration; 0: of none
  double Seconds = 0;        ///< wall time of the loop
  ClockSamples Timed;
  std::vector<float> Losses; ///< of every iteration
  /// Iterations, and the held-out views' mean PSNR after them.
  std::vector<std::pair<unsigned, double>> Scores;
  /// Names of the held-out views, and the PSNR of their 8-bit values.
  std::vector<std::pair<std::string, double>> HeldOut;
  std::optional<Baselines> Without; ///< where views are held out
  std::vector<Camera> Cameras;      ///< of all views, at their size in training
  /// What the held-out views show and should, where it was asked for.
  std::vector<std::pair<Photo, TrainView>> Shown;

  /// Mean over the held-out views, of which there are some.
  double meanDb() const;
};

/// That a run as \p R asks for can begin with \p C, the checkpoint of its
/// --from.
Expected<Success> checkBeginning(const TrainRequest &R, const Checkpoint &C);

/// Trains as \p R asks. An interrupt (SIGINT, SIGTERM) ends the run after the
/// iteration at hand, with a checkpoint and an Error that says so. The outcome
/// is the first process's; the others have nothing, and end without an Error of
/// their own, which the first one tells.
Expected<std::optional<TrainOutcome>> train(TrainRequest R,
                                            const TrainHost &Host);

} // namespace vorion::splat
