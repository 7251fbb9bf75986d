// The orientation of pictures, in EXIF's data of a JPEG, PNG or WebP.

#include "io/PhotoFile.h"
#include "vorion/support/FileKind.h"

#include <cstring>
#include <string_view>

namespace vorion::splat {
namespace {

/// The number of \p Size bytes at \p At; 0 behind the end.
uint32_t numberAt(Bytes B, std::size_t At, std::size_t Size, bool IsBig) {
  uint32_t Value = 0;
  for (std::size_t I = 0; I < Size && At + I < B.size(); ++I)
    Value |= std::to_integer<uint32_t>(B[At + I])
             << 8 * (IsBig ? Size - 1 - I : I);
  return Value;
}

Bytes partOf(Bytes B, std::size_t At, std::size_t Size) {
  return At > B.size() ? Bytes() : B.subspan(At, std::min(Size, B.size() - At));
}

/// The orientation that the TIFF data \p Exif have in their first directory.
int orientationIn(Bytes Exif) {
  constexpr uint32_t OrientationTag = 0x112;
  constexpr std::size_t EntrySize = 12;
  const bool IsBig = asText(Exif).starts_with("MM");
  const auto Directory = numberAt(Exif, 4, 4, IsBig);
  const auto Count = numberAt(Exif, Directory, 2, IsBig);
  for (std::size_t I = 0; I < Count; ++I) {
    const std::size_t At = Directory + std::size_t{2} + EntrySize * I;
    if (At + EntrySize > Exif.size())
      break;
    if (numberAt(Exif, At, 2, IsBig) != OrientationTag)
      continue;
    const auto Value = static_cast<int>(numberAt(Exif, At + 8, 2, IsBig));
    return Value >= 1 && Value <= 8 ? Value : 1;
  }
  return 1;
}

/// What EXIF data begins with in a JPEG, and in some WebPs.
constexpr std::string_view Mark("Exif\0\0", 6);

/// The EXIF segment of a JPEG, which is before its picture.
Bytes exifOfJpeg(Bytes File) {
  constexpr uint32_t App1 = 0xE1, StartOfScan = 0xDA;
  for (std::size_t At = 2; At + 4 <= File.size();) {
    const auto Marker = numberAt(File, At, 2, true);
    if (Marker >> 8 != 0xFF || (Marker & 0xFF) == StartOfScan)
      break;
    const std::size_t Size = numberAt(File, At + 2, 2, true);
    const Bytes Body = partOf(File, At + 4, Size < 2 ? 0 : Size - 2);
    if ((Marker & 0xFF) == App1 && asText(Body).starts_with(Mark))
      return Body;
    At += 2 + Size;
  }
  return {};
}

/// The chunk \p Name of a PNG (size, name, content, checksum) or of a WebP
/// (name, size, content, padding).
Bytes chunkOf(Bytes File, std::size_t First, std::string_view Name,
              bool IsPng) {
  for (std::size_t At = First; At + 8 <= File.size();) {
    const std::size_t Size = numberAt(File, At + (IsPng ? 0 : 4), 4, IsPng);
    if (asText(File).substr(At + (IsPng ? 4 : 0), 4) == Name)
      return partOf(File, At + 8, Size);
    At += 8 + Size + (IsPng ? 4 : Size % 2);
  }
  return {};
}

} // namespace

int photoOrientation(Bytes File) {
  Bytes Exif;
  switch (fileKindOf(File)) {
  case FileKind::Jpeg:
    Exif = exifOfJpeg(File);
    break;
  case FileKind::Png:
    Exif = chunkOf(File, 8, "eXIf", true);
    break;
  case FileKind::WebP:
    Exif = chunkOf(File, 12, "EXIF", false);
    break;
  default:
    break;
  }
  if (asText(Exif).starts_with(Mark))
    Exif = Exif.subspan(Mark.size());
  return orientationIn(Exif);
}

Plane turned(Plane P, int Orientation) {
  if (Orientation == 1)
    return P;
  // Orientations are mirrors of the stored rows and columns, then a swap.
  const bool Swaps = swapsSides(Orientation);
  const bool MirrorsX = Orientation == 2 || Orientation == 3 ||
                        Orientation == 7 || Orientation == 8;
  const bool MirrorsY = Orientation == 3 || Orientation == 4 ||
                        Orientation == 6 || Orientation == 7;
  Plane Out;
  Out.Width = Swaps ? P.Height : P.Width;
  Out.Height = Swaps ? P.Width : P.Height;
  Out.Rgba.resize(P.Rgba.size());
  for (std::size_t Y = 0; Y < Out.Height; ++Y)
    for (std::size_t X = 0; X < Out.Width; ++X) {
      const std::size_t FromX = Swaps ? Y : X, FromY = Swaps ? X : Y;
      const std::size_t Column = MirrorsX ? P.Width - 1 - FromX : FromX;
      const std::size_t Row = MirrorsY ? P.Height - 1 - FromY : FromY;
      std::memcpy(&Out.Rgba[4 * (Y * Out.Width + X)],
                  &P.Rgba[4 * (Row * P.Width + Column)], 4);
    }
  return Out;
}

} // namespace vorion::splat
