/// How long dispatch of a rasterizer needs for a box of pixels.
#pragma once

#include "vorion/isasim/Timing.h"

#include <cstdint>
#include <vector>

namespace vorion::isasim {

/// Cycles that dispatch needs to give a box of pixels to the lanes: in row
/// order, as many a cycle as there are lanes, until two would need the same
/// bank of the pixel buffer.
class DispatchTable {
public:
  explicit DispatchTable(const RasterTiming &Params);
  unsigned cycles(unsigned Width, unsigned Height);

private:
  unsigned count(unsigned Width, unsigned Height) const;
  const RasterTiming Timing;
  std::vector<uint16_t> Known; ///< 0: not yet
};

} // namespace vorion::isasim
