/// The settings of training, one table: those of Kerbl et al. 2023 as INRIA's
/// trainer has them.
#pragma once

#include <cstdint>

namespace vorion::splat {

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

  /// Share of 1 - SSIM in the loss; the rest is the mean absolute difference.
  double DSsim = 0.2;
  /// A band of spherical harmonics more every so many iterations.
  unsigned ShInterval = 1000;

  /// \name Density control
  /// @{
  unsigned DensifyInterval = 100;
  unsigned DensifyAfter = 500;   ///< the first time is later than this
  unsigned DensifyUntil = 15000; ///< not at this iteration any more
  double DensifyGradient = 2e-4; ///< half pictures
  double SplitExtent = 0.01;     ///< larger ones split; times the extent
  double SplitShrink = 1.6;      ///< scales of a split's halves: over this
  double LeastOpacity = 0.005;   ///< dropped below
  double MostExtent = 0.1;       ///< dropped above, after the first reset
  double MostRadius = 20;        ///< px; dropped above, after the first reset
  unsigned ResetInterval = 3000; ///< of opacities
  double ResetOpacity = 0.01;    ///< down to this
  /// On a white background opacities are reset at this iteration, too.
  unsigned WhiteReset = 500;
  uint32_t MostGaussians = 4000000;
  /// @}
};

/// The rate of positions at \p Iteration (from 1), without the extent.
double positionRate(const TrainSettings &S, unsigned Iteration);

/// Bands of spherical harmonics in use at \p Iteration, at most \p Most.
int shDegreeAt(const TrainSettings &S, unsigned Iteration, int Most);

/// What happens after the step of \p Iteration (from 1).
bool densifiesAt(const TrainSettings &S, unsigned Iteration);
bool notesAt(const TrainSettings &S, unsigned Iteration);
bool resetsAt(const TrainSettings &S, unsigned Iteration, bool White);
/// Whether large Gaussians are dropped then.
bool dropsLargeAt(const TrainSettings &S, unsigned Iteration);

} // namespace vorion::splat
