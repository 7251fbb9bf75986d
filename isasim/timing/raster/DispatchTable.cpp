#include "timing/raster/DispatchTable.h"

#include "raster/RasterTables.h"

namespace vorion::isasim {

namespace {
constexpr unsigned TableSide = raster::VR_MAX_TILE + 1;
} // namespace

DispatchTable::DispatchTable(const RasterTiming &Params)
    : Timing(Params), Known(size_t{TableSide} * TableSide) {}

unsigned DispatchTable::cycles(unsigned Width, unsigned Height) {
  uint16_t &Cycles = Known[Width * TableSide + Height];
  if (Cycles == 0)
    Cycles = static_cast<uint16_t>(count(Width, Height));
  return Cycles;
}

/// A box's place does not matter: it moves all its banks by the same number.
unsigned DispatchTable::count(unsigned Width, unsigned Height) const {
  unsigned Cycles = 1, Used = 0;
  uint64_t Banks = 0;
  for (unsigned Y = 0; Y != Height; ++Y)
    for (unsigned X = 0; X != Width; ++X) {
      const uint64_t Bank = uint64_t{1}
                            << ((X + Timing.Stagger * Y) % Timing.Banks);
      if (Used == Timing.Lanes || (Banks & Bank)) {
        ++Cycles;
        Used = 0;
        Banks = 0;
      }
      ++Used;
      Banks |= Bank;
    }
  return Cycles;
}

} // namespace vorion::isasim
