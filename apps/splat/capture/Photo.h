/// Photographs, downsampled for training.
#pragma once

#include "io/Cameras.h"
#include "io/PhotoFile.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vorion::splat {

/// A picture for training and evaluation: 8-bit r, g, b.
struct Photo {
  int Width = 0, Height = 0;
  std::vector<uint8_t> Rgb; ///< 3 bytes per pixel, rows from the top

  std::size_t pixels() const { return Rgb.size() / 3; }
};

/// The name of the filter of \c shrink in outputs.
inline constexpr const char *PhotoFilter =
    "area average of 8-bit values, rounded once";

/// \p P over \p Background (0 to 1), resized: each pixel is the average of the
/// area that it covers, including fractions of pixels. Computed in double
/// precision, and rounded to 8 bits.
Photo shrink(const Plane &P, int Width, int Height,
             const std::array<float, 3> &Background);
Photo shrink(const Photo &P, int Width, int Height);
/// The alphas of such a picture, one per pixel.
std::vector<uint8_t> shrinkAlpha(const Plane &P, int Width, int Height);

/// \p C for its picture stretched to another size, with the same field of view.
Camera stretched(const Camera &C, int Width, int Height);

/// \p Side divided by \p Factor, rounded, at least 1.
int shrunkSide(int Side, int Factor);

} // namespace vorion::splat
