/// The optimiser's step on the device.
#pragma once

#include "train/optimize/DeviceScene.h"
#include "train/settings/Settings.h"

namespace vorion::splat {

ProgramSpec adamProgram(MomentsOn Where = MomentsOn::Device);
/// For weights of opacities and scales in the loss.
ProgramSpec regularizeProgram();

constexpr bool isRegularized(const TrainSettings &S) {
  return S.OpacityWeight > 0 || S.ScaleWeight > 0;
}
/// Adds to \p Gradients those of the weights of opacities and scales.
void regularize(Launcher &L, const TrainSettings &Settings,
                const DeviceScene &S, const PlanePair &Gradients);

/// Steps all parameters of \p S by their \p Gradients, of the same layout:
/// step \p Iteration (from 1) with the rates of \p Settings, positions times
/// \p Extent. Bands above \p ActiveDegree, whose gradients would be 0 and whose
/// moments are, are left alone.
void stepAdam(Launcher &L, const TrainSettings &Settings, DeviceScene &S,
              const PlanePair &Gradients, unsigned Iteration, double Extent,
              int ActiveDegree);

} // namespace vorion::splat
