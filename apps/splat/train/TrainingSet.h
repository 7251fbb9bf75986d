/// The pictures of a capture as training uses them.
#pragma once

#include "capture/Capture.h"
#include "capture/Photo.h"

#include <array>
#include <vector>

namespace vorion::splat {

/// A view at its training size.
struct TrainView {
  Camera Pose;
  Photo Picture;
};

struct TrainingSet {
  std::vector<TrainView> Training, HeldOut; ///< by name

  /// Width and height of the largest picture.
  std::pair<int, int> largest() const;
};

/// Decodes the pictures of \p C over \p Background and makes them \p Downscale
/// times smaller (capture/Photo.h says how).
Expected<TrainingSet> loadTrainingSet(const Capture &C, int Downscale,
                                      const std::array<float, 3> &Background);

} // namespace vorion::splat
