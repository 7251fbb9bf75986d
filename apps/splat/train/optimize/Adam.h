/// The optimizer step on the device.
#pragma once

#include "train/optimize/DeviceScene.h"
#include "train/settings/Settings.h"

namespace vorion::splat {

ProgramSpec adamProgram(MomentsOn Where = MomentsOn::Device);
/// For opacity and scale regularization.
ProgramSpec regularizeProgram();

constexpr bool isRegularized(const TrainSettings &S) {
  return S.OpacityWeight > 0 || S.ScaleWeight > 0;
}
/// Adds the gradients of opacity and scale regularization to \p Gradients.
void regularize(Launcher &L, const TrainSettings &Settings,
                const DeviceScene &S, const PlanePair &Gradients);

/// Step \p Iteration (from 1) of all parameters of \p S by \p Gradients of the
/// same layout, with the rates of \p Settings; that of positions is multiplied
/// by \p Extent. Bands above \p ActiveDegree, whose gradients and moments are
/// 0, are skipped.
void stepAdam(Launcher &L, const TrainSettings &Settings, DeviceScene &S,
              const PlanePair &Gradients, unsigned Iteration, double Extent,
              int ActiveDegree);

} // namespace vorion::splat
