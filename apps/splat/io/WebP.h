/// WebP pictures as planes of data.
#pragma once

#include "io/Bytes.h"
#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// Pixels of four bytes r, g, b, a, row by row from the top.
struct Plane {
  std::size_t Width = 0, Height = 0;
  std::vector<std::byte> Rgba;

  std::size_t pixels() const { return Width * Height; }
  std::size_t bytes() const { return 4 * pixels(); }
  unsigned at(std::size_t Pixel, std::size_t Channel) const {
    return byteAt(Rgba, 4 * Pixel + Channel);
  }
};

/// Decodes a still WebP of at most \p Limit bytes unpacked, including a lossy
/// one, because the file does not record that it contains data.
Expected<Plane> decodeWebP(const std::string &Where, Bytes File,
                           std::size_t Limit);

/// \name The same in two steps, of which the second may run in any thread
/// @{
/// The plane for \p File, without contents.
Expected<Plane> planeForWebP(const std::string &Where, Bytes File,
                             std::size_t Limit);
/// Decodes \p File to \p P, the result of planeForWebP().
Expected<Success> decodeWebPInto(const std::string &Where, Bytes File,
                                 Plane &P);
/// @}

/// A lossless WebP of \p P, whose sides have at most 14 bits. Colours are
/// preserved where alpha is 0. Deterministic.
Expected<std::string> encodeWebP(const Plane &P);

} // namespace vorion::splat
