/// The settings of training. Defaults are those of Kerbl et al. 2023 in INRIA's
/// trainer. SettingsTable.h defines their names.
#pragma once

#include <cstdint>
#include <string_view>

namespace vorion::splat {

/// Density control: cloning, splitting and pruning as in Kerbl et al. 2023, or
/// relocation and sampling as in Kheradmand et al. 2024.
enum class DensityMethod { Classic, Mcmc };
constexpr std::string_view name(DensityMethod M) {
  return M == DensityMethod::Classic ? "classic" : "mcmc";
}

struct TrainSettings {
  unsigned Iterations = 30000;

  /// \name Adam
  /// @{
  double Beta1 = 0.9, Beta2 = 0.999, Epsilon = 1e-15;
  /// Learning rate of positions, in units of the cameras' extent; decays
  /// exponentially from the first to the last value over PositionSteps
  /// iterations.
  double PositionRate = 1.6e-4, LastPositionRate = 1.6e-6;
  unsigned PositionSteps = 30000;
  double ColourRate = 2.5e-3;           ///< of the constant band
  double LaterColourRate = 2.5e-3 / 20; ///< of the other bands
  double OpacityRate = 0.05;            ///< 0.025 in newer versions of INRIA's
                                        ///< trainer
  double ScaleRate = 5e-3;
  double RotationRate = 1e-3;
  /// @}

  /// Learning rate of exposures; 0: off. Decays like the rate of positions.
  double ExposureRate = 0, LastExposureRate = 1e-3;

  /// Learning rate of pose corrections; 0: off. Decays like the rate of
  /// positions.
  double PoseRate = 0, LastPoseRate = 1e-5;

  /// Weight of 1 - SSIM in the loss; the rest is the mean absolute difference.
  double DSsim = 0.2;
  /// Weights of the mean opacity and the mean scale in the loss.
  double OpacityWeight = 0, ScaleWeight = 0;
  /// Weight in the loss of the mean difference of 1 / depth from that of the
  /// capture's points, times the extent; 0: depths are not used.
  double DepthWeight = 0;
  /// Iterations between increases of the SH degree.
  unsigned ShInterval = 1000;
  /// Iterations with photographs of a quarter of their sides, and then of half;
  /// 0: they have all of their size from the beginning.
  unsigned SizeInterval = 0;

  /// \name Initial Gaussians
  /// @{
  double StartOpacity = 0.1;
  double StartScale = 1; ///< factor of the mean distance of the neighbours
  /// @}

  /// \name Density control
  /// @{
  DensityMethod Method = DensityMethod::Classic;
  unsigned DensifyInterval = 100;
  unsigned DensifyAfter = 500;   ///< exclusive
  unsigned DensifyUntil = 15000; ///< exclusive
  double DensifyGradient = 2e-4; ///< in units of half the picture
  /// Sums absolute values of gradients (Ye et al. 2024).
  bool AbsoluteGradient = false;
  double SplitExtent = 0.01;     ///< larger Gaussians are split; times the
                                 ///< extent
  double SplitShrink = 1.6;      ///< divisor of the scales after a split
  double LeastOpacity = 0.005;   ///< pruned below
  double MostExtent = 0.1;       ///< pruned above, after the first reset
  double MostRadius = 20;        ///< px; pruned above, after the first reset
  unsigned ResetInterval = 3000; ///< of opacities
  double ResetOpacity = 0.01;    ///< down to this
  /// Additional opacity reset on a white background.
  unsigned WhiteReset = 500;
  /// The default machine can train this number of Gaussians with SH degree 3
  /// (DeviceScene.h).
  uint32_t MostGaussians = 2000000;
  /// Only for MCMC: growth at a change, relative to the number of Gaussians;
  /// noise, relative to the rate of positions.
  double GrowShare = 0.05, NoiseRate = 5e5;
  /// @}
};

constexpr bool looksAtDepths(const TrainSettings &S) {
  return S.DepthWeight > 0;
}

/// The learning rate of positions at \p Iteration (from 1), without the extent.
double positionRate(const TrainSettings &S, unsigned Iteration);

constexpr bool isExposureOn(const TrainSettings &S) {
  return S.ExposureRate > 0;
}
double exposureRate(const TrainSettings &S, unsigned Iteration);

constexpr bool arePosesOn(const TrainSettings &S) { return S.PoseRate > 0; }
double poseRate(const TrainSettings &S, unsigned Iteration);

/// What the sides of photographs are divided by at \p Iteration (from 1).
int shrinkAt(const TrainSettings &S, unsigned Iteration);

/// The SH degree at \p Iteration, at most \p Most.
int shDegreeAt(const TrainSettings &S, unsigned Iteration, int Most);

/// Events after the step of \p Iteration (from 1).
bool densifiesAt(const TrainSettings &S, unsigned Iteration);
bool notesAt(const TrainSettings &S, unsigned Iteration);
bool resetsAt(const TrainSettings &S, unsigned Iteration, bool White);
/// Whether large Gaussians are pruned then.
bool dropsLargeAt(const TrainSettings &S, unsigned Iteration);

} // namespace vorion::splat
