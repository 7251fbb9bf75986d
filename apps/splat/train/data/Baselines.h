/// What pictures without a scene score: what a trained scene has to beat.
#pragma once

#include "train/data/TrainingSet.h"

#include <optional>

namespace vorion::splat {

/// Means over held-out views of the PSNR of 8-bit values, dB.
struct Baselines {
  double Constant = 0; ///< the training pictures' mean colour everywhere
  double Mean = 0;     ///< their mean, pixel by pixel
  double BestView = 0; ///< of each, the training picture that is most like it
};

/// Training pictures are brought to the size of the view that they are compared
/// with by area average. None where no view is held out.
std::optional<Baselines> baselinesOf(const TrainingSet &Set);

} // namespace vorion::splat
