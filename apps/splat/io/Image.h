/// Reading and writing of pictures: floats and 8 bits.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// A rendered picture, rows from the top. Values are as the renderer made
/// them: unclamped, in the colour space of the scene (trained scenes are in
/// sRGB already, so nothing is converted on the way to a PNG).
template <typename Real> struct BasicImage {
  int Width = 0, Height = 0;
  std::vector<Real> Render; ///< 3 a pixel: r, g, b over the background
  std::vector<Real> Alpha;  ///< 1 a pixel: 1 - final transmittance; may be
                            ///< empty where a format has no room for it
  /// Whether the values are those of 8 bits: whole 255ths.
  bool IsEightBit = false;

  std::size_t pixels() const {
    return static_cast<std::size_t>(Width) * static_cast<std::size_t>(Height);
  }
};

using Image = BasicImage<float>;
/// A picture in double precision, because an Image would round the fp64
/// reference's.
using ExactImage = BasicImage<double>;

/// 8-bit value of a channel: clamped to [0, 1], rounded to nearest; NaN is 0.
unsigned char toByte(float Value);

/// The bytes of the PNG that writePng writes.
Expected<std::string> encodePng(const Image &I);

/// 8-bit RGB PNG; alpha is not written, as the background is in the picture.
Expected<Success> writePng(const std::string &Path, const Image &I);

/// PFM ("PF", little endian, rows from the bottom as the format has them).
Expected<Success> writePfm(const std::string &Path, const Image &I);

/// Depths of a picture, rows from the top.
struct DepthMap {
  int Width = 0, Height = 0;
  /// The sum of weights times depths (camera z) of each pixel; divided by alpha
  /// it is the weighted mean depth.
  std::vector<float> Depth;
  std::vector<float> Alpha; ///< the sum of weights
};

/// Writes by the extension of \p Path: .npz with `depth` and `alpha` (H, W),
/// float32, or .pfm ("Pf", else as \c writePfm) with the first alone.
Expected<Success> writeDepth(const std::string &Path, const DepthMap &D);

/// NPZ with `render` (H, W, 3) and `alpha` (H, W), float32.
Expected<Success> writeImageNpz(const std::string &Path, const Image &I);

/// The extensions of picture files, for writing and reading.
const std::vector<std::string_view> &pictureEndings();

/// Encoding options of some formats.
struct PictureFormat {
  /// 1 to 100, for JPEG (default 95) and WebP (default: lossless).
  std::optional<int> Quality;
  bool Half = false; ///< an EXR has floats of 16 bits, not of 32
};

/// Writes by the extension of \p Path, one of pictureEndings().
Expected<Success> writeImage(const std::string &Path, const Image &I,
                             const PictureFormat &F = {});

/// Maximum side of a picture that is read, px.
inline constexpr int MaxPictureSide = 1 << 15;

/// Reads by the extension of \p Path, case-insensitively: a .pfm or .exr;
/// `render` and, where present, `alpha` of an .npz (float32 or float64, without
/// rounding); for .png, .jpg and .webp 8-bit values over black, as 0 to 1, and
/// alpha if it is not opaque everywhere.
Expected<ExactImage> readImage(const std::string &Path);

} // namespace vorion::splat
