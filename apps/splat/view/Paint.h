/// Conversion of picture layers to colours.
#pragma once

#include "device/TileWork.h"
#include "io/Image.h"
#include "view/Request.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// Bytes r, g, b, a of each pixel, and the values at both ends of the colour
/// scale.
struct Painted {
  std::string Rgba;
  double Low = 0, High = 0;
  std::string Unit; ///< empty for the picture itself
  bool IsLogarithmic = false;
};

Painted paintPicture(const Image &I);
/// Expected depth, from dark (nearest) to light (farthest); grey for empty
/// pixels.
Painted paintDepth(const DepthMap &D);
/// The largest difference of a channel from \p Reference, which has 3 values
/// per pixel, on a logarithmic scale from 1e-8, where rounding in fp32 ends, to
/// 1: the same for all pictures, so that they can be compared.
Painted paintError(const Image &I, const std::vector<double> &Reference);
Painted paintHeat(const std::vector<TileWork> &Tiles, Heat H, int Width,
                  int Height);

} // namespace vorion::splat
