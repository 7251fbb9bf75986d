/// The optimiser's step on the device.
#pragma once

#include "train/DeviceScene.h"
#include "train/Settings.h"

namespace vorion::splat {

inline constexpr const char *AdamProgram = "adam";
ProgramSpec adamProgram();

/// Steps all parameters of \p S by their \p Gradients, of the same layout:
/// step \p Iteration (from 1) with the rates of \p Settings, positions times
/// \p Extent. Bands above \p ActiveDegree, whose gradients would be 0 and whose
/// moments are, are left alone.
void stepAdam(Launcher &L, const TrainSettings &Settings, DeviceScene &S,
              const PlanePair &Gradients, unsigned Iteration, double Extent,
              int ActiveDegree);

} // namespace vorion::splat
