/// PSNR of pictures that need no scene, as baselines of a trained scene.
#pragma once

#include "train/data/TrainingSet.h"

#include <optional>

namespace vorion::splat {

/// Means over held-out views of the PSNR of 8-bit values, dB.
struct Baselines {
  double Constant = 0; ///< mean colour of the training pictures
  double Mean = 0;     ///< mean of the training pictures, per pixel
  double BestView = 0; ///< most similar training picture for each
};

/// Training pictures are resized by area averaging to the held-out view. Empty
/// if no view is held out.
std::optional<Baselines> baselinesOf(const TrainingSet &Set);

} // namespace vorion::splat
