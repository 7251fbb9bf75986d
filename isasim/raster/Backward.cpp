#include "raster/Backward.h"

#include "raster/LevelChoice.h"

#include <algorithm>
#include <limits>

namespace vorion::raster {

void BackwardBuffer::reset(unsigned X, unsigned Y, unsigned Width,
                           unsigned Height) {
  for (float *Plane : {R, G, B, T, Behind})
    std::fill_n(Plane, Pixels, 0.0F);
  std::fill_n(Last, Pixels, 0U);
  std::fill_n(RowLast, Stride, 0U);
  setCentres(CentreX, X, Width);
  setCentres(CentreY, Y, Height);
}

#define VORION_LEVEL(Name)                                                     \
  extern const BackwardDatapath BackwardDatapath_##Name;
#include "raster/Levels.inc"
#undef VORION_LEVEL

std::span<const BackwardDatapath *const> backwardDatapaths() {
  static const std::vector<const BackwardDatapath *> Usable = usableLevels({
#define VORION_LEVEL(Name) &BackwardDatapath_##Name,
#include "raster/Levels.inc"
#undef VORION_LEVEL
  });
  return Usable;
}

} // namespace vorion::raster
