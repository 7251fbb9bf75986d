/// What the two directions' datapaths share on the host's side: the levels that
/// it can run, and the centres of a tile's pixels.
#pragma once

#include "raster/RasterTables.h"

#include <initializer_list>
#include <limits>
#include <vector>

namespace vorion::raster {

/// Of \p Levels, in the order of speed, those that this host has.
template <typename Level>
std::vector<const Level *>
usableLevels(std::initializer_list<const Level *> Levels) {
  std::vector<const Level *> Result;
  for (const Level *L : Levels)
    if (L->HostSupports())
      Result.push_back(L);
  return Result;
}

/// Pixel centres along one side of a tile that begins at \p First; NaN from
/// \p Count on, which no box contains.
inline void setCentres(float (&Centres)[VR_MAX_TILE], unsigned First,
                       unsigned Count) {
  for (unsigned I = 0; I != VR_MAX_TILE; ++I)
    Centres[I] = I < Count ? static_cast<float>(First + I) + 0.5F
                           : std::numeric_limits<float>::quiet_NaN();
}

} // namespace vorion::raster
