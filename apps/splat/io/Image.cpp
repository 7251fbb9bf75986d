#include "io/Image.h"

#include "io/Exr.h"
#include "io/Npz.h"
#include "io/PhotoFile.h"
#include "io/Png.h"
#include "vorion/support/File.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Parallel.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>

static_assert(std::endian::native == std::endian::little,
              "PFM is written with a negative scale: little endian");

namespace vorion::splat {
namespace {

/// The next word of a PFM header, which one blank ends.
std::string_view nextWord(std::string_view &Text) {
  const std::size_t End = std::min(Text.find_first_of(" \t\r\n"), Text.size());
  const std::string_view Word = Text.substr(0, End);
  Text.remove_prefix(std::min(End + 1, Text.size()));
  return Word;
}

template <typename T> bool parseWhole(std::string_view Word, T &Value) {
  const auto [End, Status] =
      std::from_chars(Word.data(), Word.data() + Word.size(), Value);
  return Status == std::errc() && End == Word.data() + Word.size();
}

Expected<ExactImage> readPfm(const std::string &Path) {
  const auto File = readFile(Path);
  if (!File)
    return File.error();
  std::string_view Text(reinterpret_cast<const char *>(File->data()),
                        File->size());
  ExactImage I;
  double Scale = 0;
  if (nextWord(Text) != "PF" || !parseWhole(nextWord(Text), I.Width) ||
      !parseWhole(nextWord(Text), I.Height) ||
      !parseWhole(nextWord(Text), Scale) || I.Width < 1 || I.Height < 1 ||
      I.Width > MaxPictureSide || I.Height > MaxPictureSide) {
    constexpr const char *Wanted = "a colour PFM: `PF`, width, height, scale";
    if (fileKindOf(*File) != FileKind::Pfm)
      return otherKind(Path, *File, Wanted, "not a picture");
    return Error{Path, fmt::format("unsupported PFM, expected {}", Wanted)};
  }
  if (!(Scale < 0))
    return Error{Path, "big-endian PFM, expected a negative scale"};
  const std::size_t RowBytes =
      static_cast<std::size_t>(I.Width) * 3 * sizeof(float);
  const auto Rows = static_cast<std::size_t>(I.Height);
  if (Text.size() != Rows * RowBytes)
    return Error{Path, fmt::format("{} bytes of pixels, expected {}",
                                   Text.size(), Rows * RowBytes)};
  std::vector<float> Render(I.pixels() * 3);
  for (std::size_t Y = 0; Y < Rows; ++Y)
    std::memcpy(reinterpret_cast<char *>(Render.data()) +
                    (Rows - 1 - Y) * RowBytes,
                Text.data() + Y * RowBytes, RowBytes);
  I.Render.assign(Render.begin(), Render.end());
  return I;
}

Expected<ExactImage> readImageNpz(const std::string &Path) {
  auto File = NpzFile::open(Path);
  if (!File)
    return File.error();
  const NpyShape *R = File->find("render"), *Alpha = File->find("alpha");
  if (!R)
    return Error{Path, "no array `render`"};
  const bool Real = R->Type == "f4" || R->Type == "f8";
  if (!Real || R->Shape.size() != 3 || R->Shape[2] != 3 || R->Shape[0] < 1 ||
      R->Shape[1] < 1 || R->Shape[0] > MaxPictureSide ||
      R->Shape[1] > MaxPictureSide)
    return Error{Path, "array `render` is not a picture, expected floats of "
                       "shape (height, width, 3)"};
  ExactImage I;
  I.Height = static_cast<int>(R->Shape[0]);
  I.Width = static_cast<int>(R->Shape[1]);
  if (Alpha && Alpha->numbers() != I.pixels())
    return Error{Path, "array `alpha` does not have the size of `render`"};
  const auto Render = File->read("render");
  if (!Render)
    return Render.error();
  I.Render = Render->toDoubles();
  if (Alpha) {
    const auto Values = File->read("alpha");
    if (!Values)
      return Values.error();
    I.Alpha = Values->toDoubles();
  }
  return I;
}

} // namespace

unsigned char toByte(float Value) {
  if (!(Value > 0)) // NaN too
    return 0;
  // Rounds: the sum is positive, and exact in double.
  constexpr double Half = 0.5;
  return static_cast<unsigned char>(std::min(Value, 1.0F) * 255.0F + Half);
}

/// Three bytes a pixel.
static std::vector<unsigned char> rowsOf(const Image &I) {
  std::vector<unsigned char> Rows(I.Render.size());
  constexpr std::size_t Part = std::size_t{1} << 18; // worth a thread
  inParallelParts(Rows.size(), Part, [&](std::size_t First, std::size_t End) {
    std::transform(&I.Render[First], &I.Render[First] + (End - First),
                   &Rows[First], toByte);
  });
  return Rows;
}

Expected<std::string> encodePng(const Image &I) {
  return encodePng(rowsOf(I).data(), I.Width, I.Height);
}

Expected<Success> writePng(const std::string &Path, const Image &I) {
  const auto Png = encodePng(I);
  return Png ? writeFileAtomically(Path, *Png)
             : Expected<Success>(
                   Error{Path, Png.error().What, Png.error().Code});
}

/// \p Pixels of so many rows, three or one to a pixel.
static Expected<Success> writePfmRows(const std::string &Path, const char *Kind,
                                      int Width, int Height,
                                      const std::vector<float> &Pixels) {
  std::string Out = fmt::format("{}\n{} {}\n-1.0\n", Kind, Width, Height);
  const auto Rows = static_cast<std::size_t>(Height);
  const std::size_t Row = Pixels.size() / Rows;
  Out.reserve(Out.size() + Pixels.size() * sizeof(float));
  for (std::size_t Y = Rows; Y-- > 0;)
    Out.append(reinterpret_cast<const char *>(&Pixels[Y * Row]),
               Row * sizeof(float));
  return writeFileAtomically(Path, Out);
}

Expected<Success> writePfm(const std::string &Path, const Image &I) {
  return writePfmRows(Path, "PF", I.Width, I.Height, I.Render);
}

/// The picture's bytes, if they could be made.
static Expected<Success> writeEncoded(const std::string &Path,
                                      const Expected<std::string> &Bytes) {
  return Bytes ? writeFileAtomically(Path, *Bytes)
               : Expected<Success>(
                     Error{Path, Bytes.error().What, Bytes.error().Code});
}

Expected<Success> writeDepth(const std::string &Path, const DepthMap &D) {
  if (Path.ends_with(".pfm"))
    return writePfmRows(Path, "Pf", D.Width, D.Height, D.Depth);
  if (Path.ends_with(".exr"))
    return writeEncoded(Path, encodeExr(D));
  if (!Path.ends_with(".npz"))
    return Error{Path, "unknown file extension, expected .pfm, .exr or .npz",
                 ExitCode::Usage};
  const auto H = static_cast<std::size_t>(D.Height);
  const auto W = static_cast<std::size_t>(D.Width);
  return writeNpz(Path, {{"depth", NpyArray::of({H, W}, D.Depth)},
                         {"alpha", NpyArray::of({H, W}, D.Alpha)}});
}

Expected<Success> writeImageNpz(const std::string &Path, const Image &I) {
  const auto H = static_cast<std::size_t>(I.Height);
  const auto W = static_cast<std::size_t>(I.Width);
  Npz Arrays;
  Arrays["render"] = NpyArray::of({H, W, 3}, I.Render);
  if (!I.Alpha.empty())
    Arrays["alpha"] = NpyArray::of({H, W}, I.Alpha);
  return writeNpz(Path, Arrays);
}

const std::vector<std::string_view> &pictureEndings() {
  static const std::vector<std::string_view> Endings{
      ".png", ".jpg", ".jpeg", ".webp", ".exr", ".pfm", ".npz"};
  return Endings;
}

constexpr std::string_view UnknownEnding = "unknown file extension";

static std::string knownEndings() {
  return fmt::format("one of {}", fmt::join(pictureEndings(), ", "));
}

Expected<Success> writeImage(const std::string &Path, const Image &I,
                             const PictureFormat &F) {
  constexpr int JpegQuality = 95;
  const auto Has = [&Path](std::string_view E) { return Path.ends_with(E); };
  if (Has(".png"))
    return writePng(Path, I);
  if (Has(".pfm"))
    return writePfm(Path, I);
  if (Has(".npz"))
    return writeImageNpz(Path, I);
  if (Has(".exr"))
    return writeEncoded(Path, encodeExr(I, F.Half));
  if (Has(".jpg") || Has(".jpeg"))
    return writeEncoded(Path, encodeJpeg(rowsOf(I).data(), I.Width, I.Height,
                                         F.Quality.value_or(JpegQuality)));
  if (Has(".webp"))
    return writeEncoded(
        Path, encodeWebP(rowsOf(I).data(), I.Width, I.Height, F.Quality));
  return Error{Path,
               fmt::format("{}, expected {}", UnknownEnding, knownEndings()),
               ExitCode::Usage};
}

/// Of 8 bits a channel, over black.
static Expected<ExactImage> readPhotoFile(const std::string &Path) {
  const auto File = readFile(Path);
  if (!File)
    return File.error();
  const auto P = decodePhoto(Path, *File);
  if (!P)
    return P.error();
  ExactImage I;
  I.Width = static_cast<int>(P->Width);
  I.Height = static_cast<int>(P->Height);
  I.IsEightBit = true;
  bool Opaque = true;
  for (std::size_t Pixel = 0; Pixel < P->pixels(); ++Pixel) {
    const unsigned Alpha = P->at(Pixel, 3);
    Opaque = Opaque && Alpha == 255;
    for (std::size_t K = 0; K < 3; ++K)
      I.Render.push_back(std::round(P->at(Pixel, K) * (Alpha / 255.0)) / 255.0);
    I.Alpha.push_back(Alpha / 255.0);
  }
  if (Opaque)
    I.Alpha.clear();
  return I;
}

Expected<ExactImage> readImage(const std::string &Path) {
  const std::string Lower = lowerCase(Path);
  const auto Has = [&Lower](std::string_view E) { return Lower.ends_with(E); };
  if (Has(".pfm"))
    return readPfm(Path);
  if (Has(".npz"))
    return readImageNpz(Path);
  if (Has(".exr")) {
    const auto File = readFile(Path);
    if (File && fileKindOf(*File) != FileKind::Exr)
      return otherKind(Path, *File, "an OpenEXR picture", "not a picture");
    return File ? decodeExr(Path, *File) : File.error();
  }
  if (std::ranges::any_of(pictureEndings(), Has))
    return readPhotoFile(Path);
  Error Other = otherKindAt(Path, knownEndings(), UnknownEnding);
  Other.Code = ExitCode::Usage;
  return Other;
}

} // namespace vorion::splat
