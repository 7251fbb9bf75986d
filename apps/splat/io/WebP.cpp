#include "io/WebP.h"

#include "vorion/support/FileKind.h"

#include <fmt/format.h>
#include <webp/decode.h>
#include <webp/encode.h>

namespace vorion::splat {

static const uint8_t *dataOf(Bytes File) {
  return reinterpret_cast<const uint8_t *>(File.data());
}

Expected<Plane> planeForWebP(const std::string &Where, Bytes File,
                             std::size_t Limit) {
  WebPBitstreamFeatures Features;
  if (WebPGetFeatures(dataOf(File), File.size(), &Features) != VP8_STATUS_OK) {
    constexpr const char *Wanted = "a lossless WebP picture";
    if (fileKindOf(File) != FileKind::WebP)
      return otherKind(Where, File, Wanted, "not a WebP picture");
    return Error{Where,
                 fmt::format("damaged WebP picture, expected {}", Wanted)};
  }
  if (Features.has_animation != 0)
    return Error{Where, "an animation, expected a still WebP picture"};
  Plane P;
  P.Width = static_cast<std::size_t>(Features.width);
  P.Height = static_cast<std::size_t>(Features.height);
  if (P.bytes() > Limit) // sides have 14 bits
    return Error{Where, fmt::format("{}x{} pixels in a file of {} bytes, "
                                    "expected at most {} bytes unpacked",
                                    P.Width, P.Height, File.size(), Limit)};
  return P;
}

Expected<Success> decodeWebPInto(const std::string &Where, Bytes File,
                                 Plane &P) {
  P.Rgba.resize(P.bytes());
  if (!WebPDecodeRGBAInto(dataOf(File), File.size(),
                          reinterpret_cast<uint8_t *>(P.Rgba.data()),
                          P.Rgba.size(), static_cast<int>(4 * P.Width)))
    return Error{Where, "damaged WebP picture, expected a complete picture"};
  return Success{};
}

Expected<Plane> decodeWebP(const std::string &Where, Bytes File,
                           std::size_t Limit) {
  auto P = planeForWebP(Where, File, Limit);
  if (P)
    if (auto Decoded = decodeWebPInto(Where, File, *P); !Decoded)
      return Decoded.error();
  return P;
}

Expected<std::string> encodeWebP(const Plane &P) {
  const Error Failed{"", fmt::format("cannot encode a WebP of {}x{} pixels, "
                                     "expected sides of at most {}",
                                     P.Width, P.Height, WEBP_MAX_DIMENSION)};
  WebPConfig Config;
  WebPPicture Picture;
  if (P.Width > WEBP_MAX_DIMENSION || P.Height > WEBP_MAX_DIMENSION ||
      !WebPConfigInit(&Config) || !WebPPictureInit(&Picture) ||
      !WebPConfigLosslessPreset(&Config, 6))
    return Failed;
  Config.exact = 1;
  Picture.use_argb = 1;
  Picture.width = static_cast<int>(P.Width);
  Picture.height = static_cast<int>(P.Height);
  WebPMemoryWriter Writer;
  WebPMemoryWriterInit(&Writer);
  Picture.writer = WebPMemoryWrite;
  Picture.custom_ptr = &Writer;
  const auto *Rgba = reinterpret_cast<const uint8_t *>(P.Rgba.data());
  const bool Good = WebPPictureImportRGBA(&Picture, Rgba, 4 * Picture.width) &&
                    WebPEncode(&Config, &Picture);
  std::string Out(reinterpret_cast<const char *>(Writer.mem),
                  Good ? Writer.size : 0);
  WebPPictureFree(&Picture);
  WebPMemoryWriterClear(&Writer);
  if (!Good)
    return Failed;
  return Out;
}

} // namespace vorion::splat
