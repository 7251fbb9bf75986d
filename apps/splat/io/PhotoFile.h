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

/// Decodes a picture to 8-bit r, g, b, a (opaque if the file has no alpha;
/// 16-bit PNGs are rounded to 8). The format is recognized by content. Errors:
/// damaged, truncated or CMYK files. The values are those in the file: chunks
/// and segments about colour (gamma, primaries, profiles) are ignored. By
/// convention the values are sRGB.
Expected<Plane> decodePhoto(const std::string &Where, Bytes File);

/// The EXIF orientation of a JPEG, PNG or WebP: 1 to 8; 1 if it has none.
int photoOrientation(Bytes File);

/// Whether a picture of the EXIF orientation \p Orientation is stored with its
/// sides swapped.
constexpr bool swapsSides(int Orientation) { return Orientation >= 5; }

/// \p P, stored in the EXIF orientation \p Orientation, as it is to be seen.
Plane turned(Plane P, int Orientation);

/// \p Rgb has three bytes per pixel, rows from the top. \p Quality is 1 to 100;
/// chroma is not subsampled.
Expected<std::string> encodeJpeg(const unsigned char *Rgb, int Width,
                                 int Height, int Quality);
/// The same as WebP; lossless without a quality.
Expected<std::string> encodeWebP(const unsigned char *Rgb, int Width,
                                 int Height, std::optional<int> Quality);

} // namespace vorion::splat
