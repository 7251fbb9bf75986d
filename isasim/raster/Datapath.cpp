#include "raster/Datapath.h"

#include "raster/Command.h"
#include "raster/LevelChoice.h"

#include <cmath>

namespace vorion::raster {

void TileBuffer::reset(unsigned X, unsigned Y, unsigned Width,
                       unsigned Height) {
  // Pixels outside the tile get the same content; their centres keep them out.
  for (unsigned I = 0; I != Pixels; ++I) {
    R[I] = G[I] = B[I] = 0.0F;
    T[I] = 1.0F;
    Last[I] = 0;
  }
  setCentres(CentreX, X, Width);
  setCentres(CentreY, Y, Height);
  for (unsigned I = 0; I != Stride; ++I)
    RowLive[I] = I < Height ? Width : 0;
  Live = Width * Height;
}

void TileBuffer::set(unsigned Row, unsigned Column, const Pixel &P) {
  const unsigned At = Row * Stride + Column;
  R[At] = P.R;
  G[At] = P.G;
  B[At] = P.B;
  T[At] = P.T;
  if (!std::signbit(P.T))
    return;
  --RowLive[Row];
  --Live;
}

#define VORION_LEVEL(Name) extern const Datapath Datapath_##Name;
#include "raster/Levels.inc"
#undef VORION_LEVEL

std::span<const Datapath *const> datapaths() {
  static const std::vector<const Datapath *> Usable = usableLevels({
#define VORION_LEVEL(Name) &Datapath_##Name,
#include "raster/Levels.inc"
#undef VORION_LEVEL
  });
  return Usable;
}

} // namespace vorion::raster
