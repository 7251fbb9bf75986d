/// Undistortion of photographs to pictures of pinholes, with the validity of
/// pixels.
#pragma once

#include "io/Cameras.h"
#include "io/WebP.h"

#include <cstdint>
#include <vector>

namespace vorion::splat {

/// A picture with a mask.
struct MaskedPlane {
  Plane Picture;
  /// 1 for each valid pixel, otherwise 0; empty if all are valid.
  std::vector<uint8_t> Counts;
};

/// The name of the filter of \c undistorted in outputs.
inline constexpr const char *LensFilter =
    "bilinear between 8-bit values, rounded once";

/// Undistorts \p From, taken with the lens \p L, to the picture of a pinhole
/// with the focal lengths and principal point of \p C. Colours are weighted by
/// alpha. A pixel is valid if all its source pixels are, if it is inside \p
/// From, and if it is not beyond the fold of the lens.
MaskedPlane undistorted(const MaskedPlane &From, const Camera &C,
                        const CameraModel &L);

/// The mask of a picture of \p Width x \p Height made by \p shrink: a pixel is
/// valid if all its source pixels are.
std::vector<uint8_t> shrinkCounts(const std::vector<uint8_t> &Counts,
                                  std::size_t FromWidth, std::size_t FromHeight,
                                  int Width, int Height);

} // namespace vorion::splat
