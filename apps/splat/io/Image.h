/// Pictures in and out: floats, and 8 bits for people.
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
/// As files may have them: the fp64 reference's would be rounded in an Image.
using ExactImage = BasicImage<double>;

/// 8-bit value of a channel: clamped to [0, 1], rounded to nearest; NaN is 0.
unsigned char toByte(float Value);

/// The bytes of the PNG that writePng writes.
Expected<std::string> encodePng(const Image &I);

/// 8-bit RGB PNG; alpha is not written, as the background is in the picture.
Expected<Success> writePng(const std::string &Path, const Image &I);

/// PFM ("PF", little endian, rows from the bottom as the format has them).
Expected<Success> writePfm(const std::string &Path, const Image &I);

/// How deep a picture is, rows from the top.
struct DepthMap {
  int Width = 0, Height = 0;
  /// The sum of weights times depths (camera z) of each pixel; over alpha it is
  /// the mean depth of what is seen there.
  std::vector<float> Depth;
  std::vector<float> Alpha; ///< the sum of weights
};

/// By the ending of \p Path: .npz with `depth` and `alpha` (H, W), float32, or
/// .pfm ("Pf", else as \c writePfm) with the first alone.
Expected<Success> writeDepth(const std::string &Path, const DepthMap &D);

/// NPZ with `render` (H, W, 3) and `alpha` (H, W), float32.
Expected<Success> writeImageNpz(const std::string &Path, const Image &I);

/// The endings of files of pictures, for writing and reading.
const std::vector<std::string_view> &pictureEndings();

/// What there is to choose of some formats.
struct PictureFormat {
  /// 1 to 100: of a JPEG, 95 if nothing, and of a WebP, which keeps every byte
  /// if nothing.
  std::optional<int> Quality;
  bool Half = false; ///< an EXR has floats of 16 bits, not of 32
};

/// Writes by the ending of \p Path, one of pictureEndings().
Expected<Success> writeImage(const std::string &Path, const Image &I,
                             const PictureFormat &F = {});

/// The longest side of a picture that is read, px.
inline constexpr int MaxPictureSide = 1 << 15;

/// Reads by the ending of \p Path, in whatever case: a .pfm or .exr; `render`
/// and, where present, `alpha` of an .npz (float32 or float64; neither is
/// rounded); of .png, .jpg and .webp 8-bit values over black, as 0 to 1, and
/// alpha where it is not all opaque.
Expected<ExactImage> readImage(const std::string &Path);

} // namespace vorion::splat
