/// Photographs as small as training wants them.
#pragma once

#include "io/Cameras.h"
#include "io/PhotoFile.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vorion::splat {

/// What is trained on and measured against: 8-bit r, g, b.
struct Photo {
  int Width = 0, Height = 0;
  std::vector<uint8_t> Rgb; ///< 3 a pixel, rows from the top

  std::size_t pixels() const { return Rgb.size() / 3; }
};

/// As outputs name the filter of \c shrink.
inline constexpr const char *PhotoFilter =
    "area average of 8-bit values, rounded once";

/// \p P over \p Background (0 to 1), each pixel of the result the average of
/// the area that it covers, which may be parts of pixels. All in double, then
/// rounded to 8 bits.
Photo shrink(const Plane &P, int Width, int Height,
             const std::array<float, 3> &Background);
Photo shrink(const Photo &P, int Width, int Height);
/// The alphas of such a picture, one a pixel.
std::vector<uint8_t> shrinkAlpha(const Plane &P, int Width, int Height);

/// \p C for its picture stretched to another size: all of the view is in it.
Camera stretched(const Camera &C, int Width, int Height);

/// The side that \p Factor makes of \p Side: rounded, at least 1.
int shrunkSide(int Side, int Factor);

} // namespace vorion::splat
