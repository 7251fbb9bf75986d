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

/// Decodes a still WebP of at most \p Limit bytes unpacked; a lossy one too,
/// as nothing in it says that it holds data.
Expected<Plane> decodeWebP(const std::string &Where, Bytes File,
                           std::size_t Limit);

/// \name The same in two steps, of which the second may run in any thread
/// @{
/// The plane that \p File needs, without bytes as yet.
Expected<Plane> planeForWebP(const std::string &Where, Bytes File,
                             std::size_t Limit);
/// Fills in \p P, which planeForWebP() gave for \p File.
Expected<Success> decodeWebPInto(const std::string &Where, Bytes File,
                                 Plane &P);
/// @}

/// A lossless WebP of \p P, whose sides have at most 14 bits. Colours stay,
/// too, where alpha is 0. Equal planes make equal bytes.
Expected<std::string> encodeWebP(const Plane &P);

} // namespace vorion::splat
