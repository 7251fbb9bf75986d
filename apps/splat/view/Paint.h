/// Layers of a picture as colours.
#pragma once

#include "device/TileWork.h"
#include "io/Image.h"
#include "view/Request.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// Bytes r, g, b, a of each pixel, and what the ends of the colours stand for.
struct Painted {
  std::string Rgba;
  double Low = 0, High = 0;
  std::string Unit; ///< empty where the colours are the picture's own
};

Painted paintPicture(const Image &I);
/// The mean depth of what is seen, dark where it is near, from the nearest to
/// the farthest; grey where nothing is.
Painted paintDepth(const DepthMap &D);
/// The largest difference of a channel from \p Reference, 3 values a pixel.
Painted paintError(const Image &I, const std::vector<double> &Reference);
Painted paintHeat(const std::vector<TileWork> &Tiles, Heat H, int Width,
                  int Height);

} // namespace vorion::splat
