#include "raster/PluggedExp.h"

namespace vorion::raster {

float (*PluggedExp)(float) = nullptr;

/// A row of ExpUnits; none while there is no unit from outside.
static uint32_t Replaced = PluggedExpRow;

void plugExp(uint32_t Replaces, float (*Evaluate)(float)) {
  PluggedExp = Evaluate;
  Replaced = Replaces;
}

uint32_t expRow(uint32_t Exp) { return Exp == Replaced ? PluggedExpRow : Exp; }

} // namespace vorion::raster
