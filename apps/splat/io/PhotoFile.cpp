#include "io/PhotoFile.h"

#include "io/Cameras.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/Printable.h"

#include <array>
#include <csetjmp>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <png.h>
#include <turbojpeg.h>
#include <webp/decode.h>
#include <webp/encode.h>

namespace vorion::splat {
namespace {

Error noPhoto(const std::string &Where, Bytes File) {
  return otherKind(Where, File, "a picture as PNG, JPEG or WebP",
                   "not a picture");
}

Error damaged(const std::string &Where, const char *Kind, const char *Why) {
  return {Where, fmt::format("damaged {} ({}), expected a complete picture",
                             Kind, printable(Why))};
}

/// A PNG in memory for libpng: the part that it has not read, and what it
/// reported as an error.
struct PngSource {
  Bytes Rest;
  std::array<char, 80> Why{};
};

void takePng(png_structp Png, png_bytep To, std::size_t Size) {
  auto &Source = *static_cast<PngSource *>(png_get_io_ptr(Png));
  if (Size > Source.Rest.size())
    png_error(Png, "the file is too short");
  std::memcpy(To, Source.Rest.data(), Size);
  Source.Rest = Source.Rest.subspan(Size);
}

[[noreturn]] void failPng(png_structp Png, png_const_charp Why) {
  auto &Source = *static_cast<PngSource *>(png_get_error_ptr(Png));
  std::strncpy(Source.Why.data(), Why, Source.Why.size() - 1);
  png_longjmp(Png, 1);
}
void ignorePng(png_structp /*Png*/, png_const_charp /*Warning*/) {}

/// Reads the size of a PNG, and its values as r, g, b, a to \p Rgba, which may
/// be null. Of the values, only the number of bits is converted: libpng's
/// simplified reader would apply the chunks gAMA, cHRM, sRGB and iCCP. False if
/// libpng reported an error. libpng does so by longjmp, so no object of this
/// function has a destructor.
bool readPng(PngSource &Source, png_uint_32 &Width, png_uint_32 &Height,
             std::byte *Rgba) {
  png_structp Png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &Source,
                                           failPng, ignorePng);
  png_infop Info = Png ? png_create_info_struct(Png) : nullptr;
  if (!Info || setjmp(png_jmpbuf(Png))) { // NOLINT(bugprone-*,cert-err52-cpp)
    png_destroy_read_struct(&Png, &Info, nullptr);
    return false;
  }
  png_set_read_fn(Png, &Source, takePng);
  png_read_info(Png, Info);
  Width = png_get_image_width(Png, Info);
  Height = png_get_image_height(Png, Info);
  if (Rgba) {
    png_set_expand(Png); // palettes, fewer bits than 8, transparent colours
    png_set_scale_16(Png);
    png_set_gray_to_rgb(Png);
    png_set_add_alpha(Png, 0xFF, PNG_FILLER_AFTER);
    const int Passes = png_set_interlace_handling(Png);
    png_read_update_info(Png, Info);
    for (int Pass = 0; Pass < Passes; ++Pass)
      for (std::size_t Y = 0; Y < Height; ++Y)
        png_read_row(Png, reinterpret_cast<png_bytep>(Rgba) + 4 * Y * Width,
                     nullptr);
  }
  png_destroy_read_struct(&Png, &Info, nullptr);
  return true;
}

using Jpeg = std::unique_ptr<void, int (*)(void *)>;
Jpeg makeJpeg() { return {tjInitDecompress(), tjDestroy}; }

struct JpegHeader {
  int Width = 0, Height = 0, Subsampling = 0, Colours = 0;
};

bool readJpegHeader(const Jpeg &J, Bytes File, JpegHeader &H) {
  return tjDecompressHeader3(
             J.get(), reinterpret_cast<const unsigned char *>(File.data()),
             File.size(), &H.Width, &H.Height, &H.Subsampling, &H.Colours) == 0;
}

Expected<Plane> sized(const std::string &Where, Bytes File, PhotoSize S) {
  Plane P;
  P.Width = static_cast<std::size_t>(S.Width);
  P.Height = static_cast<std::size_t>(S.Height);
  const std::size_t Size = 4 * P.pixels();
  if (Size > unpackLimit(File.size()))
    return Error{Where, fmt::format("{}x{} pixels in a file of {} bytes, "
                                    "expected at most {} bytes unpacked",
                                    S.Width, S.Height, File.size(),
                                    unpackLimit(File.size()))};
  P.Rgba.resize(Size);
  return P;
}

Expected<Plane> decodePng(const std::string &Where, Bytes File, Plane P) {
  PngSource Source{File};
  png_uint_32 Width = 0, Height = 0;
  if (!readPng(Source, Width, Height, P.Rgba.data()))
    return damaged(Where, "PNG", Source.Why.data());
  return P;
}

Expected<Plane> decodeJpeg(const std::string &Where, Bytes File, Plane P) {
  const Jpeg J = makeJpeg();
  if (tjDecompress2(
          J.get(), reinterpret_cast<const unsigned char *>(File.data()),
          File.size(), reinterpret_cast<unsigned char *>(P.Rgba.data()),
          static_cast<int>(P.Width), 0, static_cast<int>(P.Height), TJPF_RGBA,
          // Each scan goes over all pixels, and a file may have any number.
          TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS) != 0)
    return damaged(Where, "JPEG", tjGetErrorStr2(J.get()));
  return P;
}

} // namespace

Expected<PhotoSize> photoSize(const std::string &Where, Bytes File) {
  PhotoSize S;
  switch (fileKindOf(File)) {
  case FileKind::Png: {
    PngSource Source{File};
    png_uint_32 Width = 0, Height = 0;
    if (!readPng(Source, Width, Height, nullptr))
      return damaged(Where, "PNG", Source.Why.data());
    if (Width <= MaxImageSize && Height <= MaxImageSize)
      S = {static_cast<int>(Width), static_cast<int>(Height)};
    break;
  }
  case FileKind::Jpeg: {
    const Jpeg J = makeJpeg();
    JpegHeader H;
    if (!readJpegHeader(J, File, H))
      return damaged(Where, "JPEG", tjGetErrorStr2(J.get()));
    if (H.Colours == TJCS_CMYK || H.Colours == TJCS_YCCK)
      return Error{Where, "a CMYK JPEG, expected colour or grey"};
    S = {H.Width, H.Height};
    break;
  }
  case FileKind::WebP:
    if (!WebPGetInfo(reinterpret_cast<const uint8_t *>(File.data()),
                     File.size(), &S.Width, &S.Height))
      return damaged(Where, "WebP", "its header");
    break;
  default:
    return noPhoto(Where, File);
  }
  if (S.Width < 1 || S.Height < 1 || S.Width > MaxImageSize ||
      S.Height > MaxImageSize)
    return Error{Where,
                 fmt::format("an unsupported size of picture, expected sides "
                             "of 1 to {} pixels",
                             MaxImageSize)};
  return S;
}

Expected<Plane> decodePhoto(const std::string &Where, Bytes File) {
  const auto Size = photoSize(Where, File);
  if (!Size)
    return Size.error();
  if (fileKindOf(File) == FileKind::WebP)
    return decodeWebP(Where, File, unpackLimit(File.size()));
  auto P = sized(Where, File, *Size);
  if (!P)
    return P;
  return fileKindOf(File) == FileKind::Png
             ? decodePng(Where, File, std::move(*P))
             : decodeJpeg(Where, File, std::move(*P));
}

static Error cannotEncode(const char *Kind) {
  return {"",
          fmt::format("cannot encode the picture as {}, expected memory for it",
                      Kind),
          ExitCode::LimitReached};
}

Expected<std::string> encodeJpeg(const unsigned char *Rgb, int Width,
                                 int Height, int Quality) {
  const Jpeg J{tjInitCompress(), tjDestroy};
  unsigned char *Bytes = nullptr;
  unsigned long Size = 0; // NOLINT(google-runtime-int): the library's
  const bool Good =
      J && tjCompress2(J.get(), Rgb, Width, 0, Height, TJPF_RGB, &Bytes, &Size,
                       TJSAMP_444, Quality, TJFLAG_ACCURATEDCT) == 0;
  const std::unique_ptr<unsigned char, void (*)(unsigned char *)> Owner(Bytes,
                                                                        tjFree);
  if (!Good)
    return cannotEncode("JPEG");
  return std::string(reinterpret_cast<const char *>(Bytes), Size);
}

Expected<std::string> encodeWebP(const unsigned char *Rgb, int Width,
                                 int Height, std::optional<int> Quality) {
  if (Width > WEBP_MAX_DIMENSION || Height > WEBP_MAX_DIMENSION)
    return Error{"",
                 fmt::format("{}x{} pixels, expected sides of at most {} for a "
                             "WebP",
                             Width, Height, WEBP_MAX_DIMENSION)};
  uint8_t *Bytes = nullptr;
  const std::size_t Size =
      Quality ? WebPEncodeRGB(Rgb, Width, Height, 3 * Width,
                              static_cast<float>(*Quality), &Bytes)
              : WebPEncodeLosslessRGB(Rgb, Width, Height, 3 * Width, &Bytes);
  const std::unique_ptr<void, void (*)(void *)> Owner(Bytes, WebPFree);
  if (Size == 0)
    return cannotEncode("WebP");
  return std::string(reinterpret_cast<const char *>(Bytes), Size);
}

} // namespace vorion::splat
