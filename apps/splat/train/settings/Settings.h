/// The settings of training, one table: those of Kerbl et al. 2023 as INRIA's
/// trainer has them. SettingsTable.h has their names.
#pragma once

#include <cstdint>
#include <string_view>

namespace vorion::splat {

/// How Gaussians are added and dropped: as Kerbl et al. 2023 clone, split and
/// drop them, or as Kheradmand et al. 2024 move and draw them.
enum class DensityMethod { Classic, Mcmc };
constexpr std::string_view name(DensityMethod M) {
  return M == DensityMethod::Classic ? "classic" : "mcmc";
}

struct TrainSettings {
  unsigned Iterations = 30000;

  /// \name Adam
  /// @{
  double Beta1 = 0.9, Beta2 = 0.999, Epsilon = 1e-15;
  /// Position's rate times the cameras' extent; falls exponentially from the
  /// first to the last over PositionSteps iterations.
  double PositionRate = 1.6e-4, LastPositionRate = 1.6e-6;
  unsigned PositionSteps = 30000;
  double ColourRate = 2.5e-3;           ///< of the constant band
  double LaterColourRate = 2.5e-3 / 20; ///< of the other bands
  double OpacityRate = 0.05;            ///< newer versions of INRIA's: 0.025
  double ScaleRate = 5e-3;
  double RotationRate = 1e-3;
  /// @}

  /// Of the exposures of pictures; 0: there are none. Falls like the position's
  /// rate.
  double ExposureRate = 0, LastExposureRate = 1e-3;

  /// Of the corrections of poses; 0: poses are those of the capture. Falls like
  /// the position's rate.
  double PoseRate = 0, LastPoseRate = 1e-5;

  /// Share of 1 - SSIM in the loss; the rest is the mean absolute difference.
  double DSsim = 0.2;
  /// Weights in the loss of the mean opacity and of the mean scale.
  double OpacityWeight = 0, ScaleWeight = 0;
  /// Weight in the loss of the mean difference of 1 / depth from that of the
  /// capture's points, times the extent; 0: depths are not looked at.
  double DepthWeight = 0;
  /// A band of spherical harmonics more every so many iterations.
  unsigned ShInterval = 1000;

  /// \name The first Gaussians
  /// @{
  double StartOpacity = 0.1;
  double StartScale = 1; ///< times the mean distance of the neighbours
  /// @}

  /// \name Density control
  /// @{
  DensityMethod Method = DensityMethod::Classic;
  unsigned DensifyInterval = 100;
  unsigned DensifyAfter = 500;   ///< the first time is later than this
  unsigned DensifyUntil = 15000; ///< not at this iteration any more
  double DensifyGradient = 2e-4; ///< half pictures
  /// Gradients are summed without their signs (Ye et al. 2024).
  bool AbsoluteGradient = false;
  double SplitExtent = 0.01;     ///< larger ones split; times the extent
  double SplitShrink = 1.6;      ///< scales of a split's halves: over this
  double LeastOpacity = 0.005;   ///< dropped below
  double MostExtent = 0.1;       ///< dropped above, after the first reset
  double MostRadius = 20;        ///< px; dropped above, after the first reset
  unsigned ResetInterval = 3000; ///< of opacities
  double ResetOpacity = 0.01;    ///< down to this
  /// On a white background opacities are reset at this iteration, too.
  unsigned WhiteReset = 500;
  /// The default machine holds these in training, of degree 3
  /// (DeviceScene.h).
  uint32_t MostGaussians = 2000000;
  /// Of MCMC alone: so many more at a change, over those that there are; random
  /// steps, over the rate of positions.
  double GrowShare = 0.05, NoiseRate = 5e5;
  /// @}
};

constexpr bool looksAtDepths(const TrainSettings &S) {
  return S.DepthWeight > 0;
}

/// The rate of positions at \p Iteration (from 1), without the extent.
double positionRate(const TrainSettings &S, unsigned Iteration);

constexpr bool isExposureOn(const TrainSettings &S) {
  return S.ExposureRate > 0;
}
double exposureRate(const TrainSettings &S, unsigned Iteration);

constexpr bool arePosesOn(const TrainSettings &S) { return S.PoseRate > 0; }
double poseRate(const TrainSettings &S, unsigned Iteration);

/// Bands of spherical harmonics in use at \p Iteration, at most \p Most.
int shDegreeAt(const TrainSettings &S, unsigned Iteration, int Most);

/// What happens after the step of \p Iteration (from 1).
bool densifiesAt(const TrainSettings &S, unsigned Iteration);
bool notesAt(const TrainSettings &S, unsigned Iteration);
bool resetsAt(const TrainSettings &S, unsigned Iteration, bool White);
/// Whether large Gaussians are dropped then.
bool dropsLargeAt(const TrainSettings &S, unsigned Iteration);

} // namespace vorion::splat
