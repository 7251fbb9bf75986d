/// Pictures of lenses made those of pinholes, and which of their pixels count.
#pragma once

#include "io/Cameras.h"
#include "io/WebP.h"

#include <cstdint>
#include <vector>

namespace vorion::splat {

/// A picture of which some pixels are to be left out.
struct MaskedPlane {
  Plane Picture;
  /// 1 for each pixel that counts, else 0; empty where all do.
  std::vector<uint8_t> Counts;
};

/// As outputs name the filter of \c undistorted.
inline constexpr const char *LensFilter =
    "bilinear between 8-bit values, rounded once";

/// What a pinhole with the focal lengths and principal point of \p C would have
/// taken in place of \p From, which a camera with the lens \p L took. Colours
/// are weighed by their alpha. A pixel counts where all that it is made of
/// counts: not outside \p From, and not where the lens folds back.
MaskedPlane undistorted(const MaskedPlane &From, const Camera &C,
                        const CameraModel &L);

/// Of the pixels of a picture of \p Width x \p Height that \p shrink makes:
/// those count that are made of pixels that count alone.
std::vector<uint8_t> shrinkCounts(const std::vector<uint8_t> &Counts,
                                  std::size_t FromWidth, std::size_t FromHeight,
                                  int Width, int Height);

} // namespace vorion::splat
