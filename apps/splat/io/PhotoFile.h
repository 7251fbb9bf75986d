/// Pictures of 8 bits in files: PNG, JPEG, WebP.
#pragma once

#include "io/Bytes.h"
#include "io/WebP.h"
#include "vorion/support/Expected.h"

#include <optional>
#include <string>

namespace vorion::splat {

struct PhotoSize {
  int Width = 0, Height = 0;
};

/// The size that the header of a PNG, JPEG or WebP states.
Expected<PhotoSize> photoSize(const std::string &Where, Bytes File);

/// Decodes one to 8-bit r, g, b, a (opaque where the file has no alpha; 16-bit
/// PNGs are rounded to 8). Told by the content. Damaged, cut or CMYK files are
/// errors; values stay in the file's colour space, sRGB by custom.
Expected<Plane> decodePhoto(const std::string &Where, Bytes File);

/// \p Rgb has three bytes a pixel, rows from the top. \p Quality is 1 to 100;
/// colours have every pixel's.
Expected<std::string> encodeJpeg(const unsigned char *Rgb, int Width,
                                 int Height, int Quality);
/// The same as WebP; without a quality every byte is kept.
Expected<std::string> encodeWebP(const unsigned char *Rgb, int Width,
                                 int Height, std::optional<int> Quality);

} // namespace vorion::splat
