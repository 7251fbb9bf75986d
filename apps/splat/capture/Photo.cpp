#include "capture/Photo.h"

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <fmt/format.h>
#include <memory>
#include <png.h>
#include <turbojpeg.h>
#include <webp/decode.h>

namespace vorion::splat {
namespace {

enum class PhotoKind { Png, Jpeg, WebP, None };

PhotoKind kindOf(Bytes File) {
  const std::string_view Text = asText(File);
  if (Text.starts_with("\x89PNG\r\n\x1a\n"))
    return PhotoKind::Png;
  if (Text.starts_with("\xff\xd8\xff"))
    return PhotoKind::Jpeg;
  if (Text.starts_with("RIFF") && Text.substr(0, 12).ends_with("WEBP"))
    return PhotoKind::WebP;
  return PhotoKind::None;
}

Error noPhoto(const std::string &Where) {
  return {Where, "not a picture, expected a PNG, JPEG or WebP"};
}

Error damaged(const std::string &Where, const char *Kind, const char *Why) {
  return {Where, fmt::format("damaged {} ({}), expected a whole one", Kind,
                             printable(Why))};
}

/// libpng's simplified reader, and its release.
struct PngReader {
  png_image Image{};

  explicit PngReader(Bytes File) {
    Image.version = PNG_IMAGE_VERSION;
    png_image_begin_read_from_memory(&Image, File.data(), File.size());
    // Values, not light: no conversion from 16-bit linear.
    Image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  }
  ~PngReader() { png_image_free(&Image); }
  PngReader(const PngReader &) = delete;
  PngReader &operator=(const PngReader &) = delete;

  /// A warning means that bytes were wrong (a checksum, say).
  bool good() const { return PNG_IMAGE_FAILED(Image) == 0; }
};

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
  PngReader Png(File);
  Png.Image.format = PNG_FORMAT_RGBA;
  if (!Png.good() ||
      !png_image_finish_read(&Png.Image, nullptr, P.Rgba.data(), 0, nullptr) ||
      !Png.good())
    return damaged(Where, "PNG", Png.Image.message);
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

/// Which source pixels a result pixel covers along one axis: from \c First on,
/// with these shares of their length.
struct Cover {
  std::size_t First = 0;
  std::vector<double> Shares;
};

std::vector<Cover> coversOf(std::size_t From, std::size_t To) {
  std::vector<Cover> Covers(To);
  const double Step = static_cast<double>(From) / static_cast<double>(To);
  for (std::size_t I = 0; I < To; ++I) {
    const double Begin = static_cast<double>(I) * Step, End = Begin + Step;
    Cover &C = Covers[I];
    C.First = std::min(static_cast<std::size_t>(Begin), From - 1);
    const auto Last = std::min(
        From, std::max(C.First + 1, static_cast<std::size_t>(std::ceil(End))));
    for (std::size_t K = C.First; K < Last; ++K) {
      const auto Left = static_cast<double>(K);
      C.Shares.push_back(
          std::max(0.0, std::min(End, Left + 1) - std::max(Begin, Left)));
    }
  }
  return Covers;
}

/// \p At(pixel, channel) gives 0 to 255.
template <typename Function>
Photo averaged(std::size_t FromWidth, std::size_t FromHeight, int Width,
               int Height, Function At) {
  Photo Out;
  Out.Width = Width;
  Out.Height = Height;
  const std::vector<Cover> Columns =
      coversOf(FromWidth, static_cast<std::size_t>(Width));
  const std::vector<Cover> Rows =
      coversOf(FromHeight, static_cast<std::size_t>(Height));
  Out.Rgb.reserve(3 * Columns.size() * Rows.size());
  for (const Cover &Row : Rows)
    for (const Cover &Column : Columns) {
      std::array<double, 3> Sum{};
      double Area = 0;
      for (std::size_t R = 0; R < Row.Shares.size(); ++R)
        for (std::size_t C = 0; C < Column.Shares.size(); ++C) {
          const double Share = Row.Shares[R] * Column.Shares[C];
          const std::size_t Pixel =
              (Row.First + R) * FromWidth + Column.First + C;
          for (std::size_t K = 0; K < 3; ++K)
            Sum[K] += Share * At(Pixel, K);
          Area += Share;
        }
      for (const double S : Sum)
        Out.Rgb.push_back(
            static_cast<uint8_t>(std::clamp(std::lround(S / Area), 0L, 255L)));
    }
  return Out;
}

} // namespace

Expected<PhotoSize> photoSize(const std::string &Where, Bytes File) {
  PhotoSize S;
  switch (kindOf(File)) {
  case PhotoKind::Png: {
    const PngReader Png(File);
    if (!Png.good())
      return damaged(Where, "PNG", Png.Image.message);
    if (Png.Image.width <= MaxImageSize && Png.Image.height <= MaxImageSize)
      S = {static_cast<int>(Png.Image.width),
           static_cast<int>(Png.Image.height)};
    break;
  }
  case PhotoKind::Jpeg: {
    const Jpeg J = makeJpeg();
    JpegHeader H;
    if (!readJpegHeader(J, File, H))
      return damaged(Where, "JPEG", tjGetErrorStr2(J.get()));
    if (H.Colours == TJCS_CMYK || H.Colours == TJCS_YCCK)
      return Error{Where, "a CMYK JPEG, expected one in colour or grey"};
    S = {H.Width, H.Height};
    break;
  }
  case PhotoKind::WebP:
    if (!WebPGetInfo(reinterpret_cast<const uint8_t *>(File.data()),
                     File.size(), &S.Width, &S.Height))
      return damaged(Where, "WebP", "its header");
    break;
  case PhotoKind::None:
    return noPhoto(Where);
  }
  if (S.Width < 1 || S.Height < 1 || S.Width > MaxImageSize ||
      S.Height > MaxImageSize)
    return Error{Where, fmt::format("a picture of unusual size, expected sides "
                                    "of 1 to {} pixels",
                                    MaxImageSize)};
  return S;
}

Expected<Plane> decodePhoto(const std::string &Where, Bytes File) {
  const auto Size = photoSize(Where, File);
  if (!Size)
    return Size.error();
  if (kindOf(File) == PhotoKind::WebP)
    return decodeWebP(Where, File, unpackLimit(File.size()));
  auto P = sized(Where, File, *Size);
  if (!P)
    return P;
  return kindOf(File) == PhotoKind::Png
             ? decodePng(Where, File, std::move(*P))
             : decodeJpeg(Where, File, std::move(*P));
}

Photo shrink(const Plane &P, int Width, int Height,
             const std::array<float, 3> &Background) {
  return averaged(P.Width, P.Height, Width, Height,
                  [&](std::size_t Pixel, std::size_t Channel) {
                    const double Alpha = P.at(Pixel, 3) / 255.0;
                    return P.at(Pixel, Channel) * Alpha +
                           255.0 * Background[Channel] * (1 - Alpha);
                  });
}

Photo shrink(const Photo &P, int Width, int Height) {
  return averaged(static_cast<std::size_t>(P.Width),
                  static_cast<std::size_t>(P.Height), Width, Height,
                  [&](std::size_t Pixel, std::size_t Channel) -> double {
                    return P.Rgb[3 * Pixel + Channel];
                  });
}

std::vector<uint8_t> shrinkAlpha(const Plane &P, int Width, int Height) {
  // The same in all channels.
  const Photo All =
      averaged(P.Width, P.Height, Width, Height,
               [&](std::size_t Pixel, std::size_t /*Channel*/) -> double {
                 return P.at(Pixel, 3);
               });
  std::vector<uint8_t> Alpha(All.pixels());
  for (std::size_t I = 0; I < Alpha.size(); ++I)
    Alpha[I] = All.Rgb[3 * I];
  return Alpha;
}

Camera resized(const Camera &C, int Width, int Height) {
  Camera R = C;
  const double X = static_cast<double>(Width) / C.Width;
  const double Y = static_cast<double>(Height) / C.Height;
  R.Width = Width;
  R.Height = Height;
  R.Fx *= X;
  R.Cx *= X;
  R.Fy *= Y;
  R.Cy *= Y;
  return R;
}

int shrunkSide(int Side, int Factor) {
  return std::max(1, (Side + Factor / 2) / Factor);
}

} // namespace vorion::splat
