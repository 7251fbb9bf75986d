/// What a run took of the chip's energy, by what it goes along with.
#pragma once

#include "vorion/isasim/Energy.h"
#include "vorion/isasim/Timing.h"

namespace vorion::isasim {

/// Joules.
struct ChipEnergy {
  double Cores = 0;       ///< with instructions that they issue
  double Rasterizers = 0; ///< with pixels that they blend
  double PixelUnits = 0;  ///< with Gaussians that they evaluate
  double Always = 0; ///< clocks of cores, leakage, wires, an L2 on the chip
};
/// By \p Model; without one by the default technology, at the voltage that the
/// clock needs or, if there is none, at the technology's own.
ChipEnergy chipEnergyOf(const TimeReport &R,
                        const EnergyModel *Model = nullptr);

} // namespace vorion::isasim
