/// Boxes of pixels for tests of the rasterizers' clock.
#pragma once

#include "raster/WorkLog.h"

#include <cstdint>

namespace vorion::isasim {

/// A Gaussian without a record in memory, whose box all gets lanes.
inline raster::GaussianWork box(unsigned X, unsigned Y, unsigned Width,
                                unsigned Height) {
  return {0,
          static_cast<uint8_t>(X),
          static_cast<uint8_t>(Y),
          static_cast<uint8_t>(Width),
          static_cast<uint8_t>(Height),
          static_cast<uint16_t>(Width * Height),
          false};
}

} // namespace vorion::isasim
