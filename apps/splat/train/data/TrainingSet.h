/// The pictures of a capture as training uses them.
#pragma once

#include "capture/Capture.h"
#include "capture/Photo.h"
#include "render/DepthTargets.h"

#include <array>
#include <vector>

namespace vorion::splat {

/// A view at its training size.
struct TrainView {
  Camera Pose;
  Photo Picture; ///< 0 where a pixel does not count
  /// 1 for each pixel that counts, else 0; empty where all do.
  std::vector<uint8_t> Counts;
  /// Of each pixel, for another background than the picture's; empty where it
  /// was not asked for, or where all are opaque.
  std::vector<uint8_t> Alpha;
  /// If asked for (DepthPoints.h).
  // May be left out: NOLINTNEXTLINE(readability-redundant-member-init)
  std::vector<DepthPoint> Depths{};
};

/// \c Picture of \p V, which lies over \p Was, over \p Is, in 8 bits.
Photo over(const TrainView &V, const std::array<float, 3> &Was,
           const std::array<float, 3> &Is);

/// How pictures are loaded.
struct LoadOptions {
  int Downscale = 1; ///< times smaller (capture/Photo.h says how)
  std::array<float, 3> Background{};
  MaskSource Masks = MaskSource::None; ///< as the capture was read
  bool KeepAlpha = false;
  bool KeepDepths = false;
  /// Photographs stay as they are, and poses get their lenses.
  LensOf Pictures = LensOf::Undistorted;
};

struct TrainingSet {
  std::vector<TrainView> Training, HeldOut; ///< by name

  std::vector<Camera> cameras() const;
  /// Width and height of the largest picture.
  std::pair<int, int> largest() const;
  /// Points whose depth is known, in all training pictures.
  std::size_t depths() const;
};

/// Decodes the pictures of \p C, undistorts them if they are to be
/// (capture/Undistort.h), and makes them smaller over the background.
Expected<TrainingSet> loadTrainingSet(const Capture &C, const LoadOptions &O);

} // namespace vorion::splat
