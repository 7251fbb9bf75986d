/// The loop: density control, views, their loss, the way back, a step.
#pragma once

#include "picture/Options.h"
#include "train/data/TrainingSet.h"
#include "train/data/ViewOrder.h"
#include "train/optimize/Density.h"
#include "train/optimize/Exposure.h"
#include "train/optimize/GradientRenderer.h"
#include "train/optimize/Mcmc.h"
#include "train/optimize/PictureLoss.h"
#include "train/optimize/Pose.h"
#include "train/run/Checkpoint.h"
#include "train/run/Ranks.h"
#include "train/run/ViewBatch.h"
#include "train/settings/Settings.h"

#include <optional>

namespace vorion::splat {

/// What makes one run another.
struct TrainRun {
  TrainSettings Settings;
  uint64_t Seed = 0;
  /// Hash of the checkpoint of another run that it begins with, or empty.
  std::string From;
  std::string Points;                ///< else hash of those that it begins with
  double Extent = 1;                 ///< of the cameras
  unsigned Batch = 1;                ///< views an iteration
  std::array<float, 3> Background{}; ///< of held-out views at least
  /// Each training picture has one of its own.
  bool RandomBackground = false;
  MaskSource Masks = MaskSource::None;
  bool Antialiased = false; ///< scene/Drawing.h
  /// Whether photographs are taken as they are, through their lenses.
  LensOf Pictures = LensOf::Undistorted;
  Spread Through = Spread::Jacobian;

  /// Which has a reset more.
  bool isWhite() const {
    return !RandomBackground && Background == std::array<float, 3>{1, 1, 1};
  }
};

/// What an iteration did.
struct StepReport {
  unsigned Iteration = 0; ///< from 1
  LossValues Loss;
  uint32_t Gaussians = 0;               ///< after it
  std::optional<DensityChange> Density; ///< if it changed before the views
};

/// One run, on a device of each process. Results depend on run, pictures and
/// starting scene only, not on the number of processes; errors stick in the
/// launcher, those of step() in the launchers of all processes.
class Trainer {
public:
  /// The programs that training on \p Pictures runs beside the renderer's.
  static std::vector<ProgramSpec> programs(const TrainSettings &Settings,
                                           const TrainingSet &Pictures,
                                           MomentsOn Where = MomentsOn::Device);

  /// \p Pictures, \p Run, \p Renderer and \p Processes must outlive this.
  Trainer(Launcher &Launch, GradientRenderer &Renderer,
          const TrainingSet &Pictures, const TrainRun &Run, Ranks &Processes,
          MomentsOn Where = MomentsOn::Device);

  void start(const Scene &S);
  void restore(const Checkpoint &C);
  /// All but \c Checkpoint::Run.
  Checkpoint save();

  StepReport step();
  unsigned iteration() const { return Done; }
  uint32_t gaussians() const { return State.Count; }
  const std::vector<float> &losses() const { return Losses; }
  Scene scene();
  /// Of training view number \p View, as training has corrected it.
  Camera pose(std::size_t View) const { return Posed.at(View); }
  PoseChange poseChange() const { return Posed.change(); }

  /// The scene from \p C, rounded to 8 bits.
  Photo render(const Camera &C);
  /// PSNR of 8-bit values of every held-out view, dB, in their order.
  std::vector<double> evaluate();

private:
  bool isChangeDue() const;
  std::optional<DensityChange> changeDensity();
  bool allSucceeded();
  ViewBatch::ViewResult take(uint64_t Place, int ShDegree);
  ViewBatch::ViewResult lossOf(const cl::Buffer &Picture, std::size_t View,
                               const Photo &Target);
  DepthTargets depthsOf(std::size_t View) const;
  void stepExposures();
  void stepPoses();

  Launcher &Launch;
  GradientRenderer &Renderer;
  const TrainingSet &Pictures;
  const TrainRun &Run;
  ViewOrder Order;
  PictureLoss Loss;
  Exposures Exposed;
  Poses Posed;
  Ranks &Processes;
  DensityControl Density;
  McmcControl Mcmc;
  ViewBatch Batch;
  const MomentsOn Where;
  DeviceScene State;
  unsigned Done = 0;
  std::vector<float> Losses;
};

} // namespace vorion::splat
