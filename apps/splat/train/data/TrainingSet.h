/// The pictures of a capture, prepared for training.
#pragma once

#include "capture/Capture.h"
#include "capture/Photo.h"
#include "render/DepthTargets.h"

#include <array>
#include <vector>

namespace vorion::splat {

/// A view at training size.
struct TrainView {
  Camera Pose;
  Photo Picture; ///< 0 at masked pixels
  /// 1 for each pixel that is used, otherwise 0; empty if all are used.
  std::vector<uint8_t> Counts;
  /// Alpha of each pixel, to change the background of the picture; empty if not
  /// requested, or if all pixels are opaque.
  std::vector<uint8_t> Alpha;
  /// If requested (DepthPoints.h).
  // May be left out: NOLINTNEXTLINE(readability-redundant-member-init)
  std::vector<DepthPoint> Depths{};
};

/// \c Picture of \p V, whose background is \p Was, over the background \p Is,
/// in 8 bits.
Photo over(const TrainView &V, const std::array<float, 3> &Was,
           const std::array<float, 3> &Is);

/// \p V with its sides divided by \p Factor. Depths fall into the smaller
/// picture's pixels.
TrainView shrunk(const TrainView &V, int Factor);

/// Options for loading pictures.
struct LoadOptions {
  int Downscale = 1; ///< downsampling factor (capture/Photo.h)
  std::array<float, 3> Background{};
  MaskSource Masks = MaskSource::None; ///< those of CaptureOptions
  bool KeepAlpha = false;
  bool KeepDepths = false;
  /// LensOf::Photograph keeps the original photographs, and sets the lenses of
  /// poses.
  LensOf Pictures = LensOf::Undistorted;
};

struct TrainingSet {
  std::vector<TrainView> Training, HeldOut; ///< by name

  std::vector<Camera> cameras() const;
  /// Width and height of the largest picture.
  std::pair<int, int> largest() const;
  /// Number of points with a known depth in all training pictures.
  std::size_t depths() const;
};

/// Decodes the pictures of \p C, undistorts them if requested
/// (capture/Undistort.h), composites them over the background, and downsamples
/// them.
Expected<TrainingSet> loadTrainingSet(const Capture &C, const LoadOptions &O);

} // namespace vorion::splat
