/// The training loop: density control, views, loss, backward pass, optimizer
/// step.
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
#include "train/run/TileShare.h"
#include "train/run/ViewBatch.h"
#include "train/settings/Settings.h"

#include <functional>
#include <optional>

namespace vorion::splat {

/// The parameters of a run.
struct TrainRun {
  TrainSettings Settings;
  uint64_t Seed = 0;
  /// Hash of the initial checkpoint of another run, or empty.
  std::string From;
  std::string Points;                ///< otherwise hash of the initial points
  double Extent = 1;                 ///< of the cameras
  unsigned Batch = 1;                ///< views per iteration
  std::array<float, 3> Background{}; ///< of held-out views, and of training
                                     ///< views unless random
  /// Whether each training picture has a random background.
  bool RandomBackground = false;
  MaskSource Masks = MaskSource::None;
  bool Antialiased = false; ///< scene/Drawing.h
  /// Whether original photographs are used, with their lenses.
  LensOf Pictures = LensOf::Undistorted;
  Spread Through = Spread::Jacobian;
  RendererKind Kind = RendererKind::Splat;
  unsigned FalloffDegree = 2; ///< scene/Drawing.h
  /// Depth of the near plane; empty: that of the rules.
  std::optional<float> Near = std::nullopt;
  /// Of the frame in which the scene is trained (\c CapturePoints). Cameras and
  /// the result are in the capture's.
  WorldPoint Origin{};

  /// Whether the background is white, which adds an opacity reset.
  bool isWhite() const {
    return !RandomBackground && Background == std::array<float, 3>{1, 1, 1};
  }
};

/// The result of an iteration.
struct StepReport {
  unsigned Iteration = 0; ///< from 1
  LossValues Loss;
  uint32_t Gaussians = 0;               ///< after it
  std::optional<DensityChange> Density; ///< if the density changed in this
                                        ///< iteration
};

/// A run on the devices of all processes. Results depend only on run, pictures
/// and initial scene, not on the number of processes. The launcher keeps
/// errors; errors of step() are kept in the launchers of all processes.
class Trainer {
public:
  /// The programs of training on \p Pictures, in addition to those of the
  /// renderer.
  static std::vector<ProgramSpec>
  programs(const TrainSettings &Settings, const TrainingSet &Pictures,
           MomentsOn Where = MomentsOn::Device,
           RendererKind Kind = RendererKind::Splat);

  /// \p Pictures, \p Run, \p Renderer and \p Processes must outlive this.
  Trainer(Launcher &Launch, GradientRenderer &Renderer,
          const TrainingSet &Pictures, const TrainRun &Run, Ranks &Processes,
          MomentsOn Where = MomentsOn::Device);

  void start(const Scene &S);
  void restore(const Checkpoint &C);
  /// Sets all members except \c Checkpoint::Run.
  Checkpoint save();

  /// \p Whole: each process renders whole pictures, so that its stages are
  /// those of a run of one process.
  StepReport step(bool Whole = false);
  unsigned iteration() const { return Done; }
  uint32_t gaussians() const { return State.Count; }
  const std::vector<float> &losses() const { return Losses; }
  Scene scene();
  /// The corrected pose of training view \p View.
  Camera pose(std::size_t View) const;
  PoseChange poseChange() const { return Posed.change(); }

  /// Renders the scene in the view \p C, rounded to 8 bits.
  Photo render(const Camera &C);
  /// PSNR of the 8-bit values of each held-out view, dB. \p Take, if set, gets
  /// each view and its picture.
  std::vector<double>
  evaluate(const std::function<void(const TrainView &, Photo)> &Take = nullptr);

private:
  bool isChangeDue() const;
  std::optional<DensityChange> changeDensity();
  ViewBatch::ViewResult take(uint64_t Place, int ShDegree);
  /// Training view \p View at the size of the next iteration.
  const TrainView &sized(std::size_t View);
  cl::Buffer forward(std::size_t View, const TrainView &Sized, int ShDegree);
  ViewBatch::ViewResult lossOf(const cl::Buffer &Picture, std::size_t View,
                               const TrainView &Sized, const Photo &Target);
  DepthTargets depthsOf(const TrainView &V) const;
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
  TileShare Share;
  /// Of the pictures of this iteration; null: they are not divided.
  TileDivision *Division = nullptr;
  const MomentsOn Where;
  DeviceScene State;
  /// Views that are divided by Shrink, as far as they have been needed.
  std::vector<std::optional<TrainView>> Smaller;
  int Shrink = 1;
  unsigned Done = 0;
  std::vector<float> Losses;
};

} // namespace vorion::splat
