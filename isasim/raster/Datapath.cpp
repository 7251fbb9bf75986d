#include "raster/Datapath.h"

#include <limits>
#include <vector>

namespace vorion::raster {

void TileBuffer::reset(unsigned X, unsigned Y, unsigned Width,
                       unsigned Height) {
  // Pixels outside the tile get the same content; their centres keep them out.
  for (unsigned I = 0; I != Pixels; ++I) {
    R[I] = G[I] = B[I] = 0.0F;
    T[I] = 1.0F;
  }
  constexpr float Nowhere = std::numeric_limits<float>::quiet_NaN();
  for (unsigned I = 0; I != Stride; ++I) {
    CentreX[I] = I < Width ? static_cast<float>(X + I) + 0.5F : Nowhere;
    CentreY[I] = I < Height ? static_cast<float>(Y + I) + 0.5F : Nowhere;
    RowLive[I] = I < Height ? Width : 0;
  }
  Live = Width * Height;
}

#define VORION_LEVEL(Name) extern const Datapath Datapath_##Name;
#include "raster/Levels.inc"
#undef VORION_LEVEL

std::span<const Datapath *const> datapaths() {
  static const std::vector<const Datapath *> Usable = [] {
    std::vector<const Datapath *> Result;
    for (const Datapath *Level : {
#define VORION_LEVEL(Name) &Datapath_##Name,
#include "raster/Levels.inc"
#undef VORION_LEVEL
         })
      if (Level->HostHasIt())
        Result.push_back(Level);
    return Result;
  }();
  return Usable;
}

} // namespace vorion::raster
