/// An exponential unit from outside of the simulator (vorion/isasim/Plugin.h).
/// Included by the files that are compiled once per vector level, too: defines
/// no function.
#pragma once

#include "raster/UnitTables.h"

#include <cstdint>

namespace vorion::raster {

/// Where the datapaths' tables of exponential units have it: after the rows of
/// ExpUnits.
inline constexpr uint32_t PluggedExpRow = ExpUnitCount;
inline constexpr uint32_t ExpRowCount = ExpUnitCount + 1;

/// exp(Power) for Power <= 0; null while there is none.
extern float (*PluggedExp)(float Power);

/// Computes with \p Evaluate in the place of ExpUnits[\p Replaces], in all
/// machines of the process. Called before any of them runs.
void plugExp(uint32_t Replaces, float (*Evaluate)(float));

/// The row of the tables for LaneUnits::Exp \p Exp.
uint32_t expRow(uint32_t Exp);

} // namespace vorion::raster
