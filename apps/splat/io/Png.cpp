#include "io/Png.h"

#include "vorion/support/Parallel.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <span>
#include <string_view>
#include <utility>
#include <vector>
#include <zlib.h>

namespace vorion::splat {
namespace {

constexpr std::size_t PixelBytes = 3;
/// Of PNG's filters.
constexpr unsigned char Paeth = 4;

/// Of rows so filtered, matches of distance 1 alone make a frame of
/// garden_outdoor at 3840x2160 as small as zlib's level 3 in half its time, and
/// plainer pictures smaller in two thirds.
constexpr int Level = 1, Strategy = Z_RLE;
/// Of a zlib stream: a window of 32 KiB, the fastest level.
constexpr std::string_view StreamHeader = "\x78\x01";

/// The order of bytes of PNG and of zlib streams.
std::string bigEndian(uLong Word) {
  std::string Bytes;
  for (const int Shift : {24, 16, 8, 0})
    Bytes += static_cast<char>(Word >> Shift);
  return Bytes;
}

std::string chunk(std::string_view Type, std::string_view Data) {
  std::string Chunk = bigEndian(Data.size());
  const std::size_t Checked = Chunk.size();
  Chunk.append(Type).append(Data);
  const uLong Crc = crc32(0, reinterpret_cast<const Bytef *>(&Chunk[Checked]),
                          static_cast<uInt>(Chunk.size() - Checked));
  return Chunk += bigEndian(Crc);
}

/// The neighbour that is nearest to Left + Up - Corner.
int paeth(int Left, int Up, int Corner) {
  const int FromLeft = std::abs(Up - Corner), FromUp = std::abs(Left - Corner),
            FromCorner = std::abs(Left + Up - 2 * Corner);
  const int Other = FromUp <= FromCorner ? Up : Corner;
  return FromLeft <= FromUp && FromLeft <= FromCorner ? Left : Other;
}

/// Filters \p Row, of \p Size bytes, to \p To. \p Above is the row above it,
/// null for the first one.
void filter(const unsigned char *Row, const unsigned char *Above,
            std::size_t Size, unsigned char *To) {
  *To++ = Paeth;
  for (std::size_t K = 0; K < PixelBytes; ++K)
    To[K] = static_cast<unsigned char>(Row[K] - (Above ? Above[K] : 0));
  for (std::size_t K = PixelBytes; K < Size; ++K) {
    const int Left = Row[K - PixelBytes];
    To[K] = static_cast<unsigned char>(
        Row[K] - (Above ? paeth(Left, Above[K], Above[K - PixelBytes]) : Left));
  }
}

/// A part of the compressed stream.
struct Strip {
  std::string Chunk;  ///< empty if there was no memory for it
  uLong Checksum = 0; ///< of the bytes that it unpacks to
};

/// \p Rows are the last ones of the picture if it \p Ends with them.
Strip stripOf(std::span<const unsigned char> Rows, bool Ends) {
  constexpr int NoHeader = -15, DefaultMemory = 8;
  z_stream Z{};
  if (deflateInit2(&Z, Level, Z_DEFLATED, NoHeader, DefaultMemory, Strategy) !=
      Z_OK)
    return {};
  const auto Size = static_cast<uInt>(Rows.size());
  constexpr std::size_t FlushBytes = 16; // more than a flush appends
  std::string Data(deflateBound(&Z, Size) + FlushBytes, '\0');
  Z.next_in = const_cast<Bytef *>(Rows.data()); // zlib's, which only reads
  Z.avail_in = Size;
  Z.next_out = reinterpret_cast<Bytef *>(Data.data());
  Z.avail_out = static_cast<uInt>(Data.size());
  deflate(&Z, Ends ? Z_FINISH : Z_SYNC_FLUSH);
  assert(Z.avail_in == 0 && Z.avail_out != 0);
  Data.resize(Z.total_out);
  deflateEnd(&Z);
  return {chunk("IDAT", Data), adler32(1, Rows.data(), Size)};
}

} // namespace

Expected<std::string> encodePng(const unsigned char *Rgb, int Width,
                                int Height) {
  const auto Rows = static_cast<std::size_t>(Height);
  const std::size_t RowBytes = PixelBytes * static_cast<std::size_t>(Width);
  const std::size_t Stride = 1 + RowBytes; // with the filter's number
  constexpr std::size_t StripBytes = std::size_t{1} << 18;
  const std::size_t Each = std::max<std::size_t>(1, StripBytes / Stride);
  std::vector<Strip> Strips((Rows + Each - 1) / Each);
  inParallelParts(Rows, Each, [&](std::size_t First, std::size_t End) {
    std::vector<unsigned char> Filtered((End - First) * Stride);
    for (std::size_t Y = First; Y < End; ++Y)
      filter(Rgb + Y * RowBytes, Y == 0 ? nullptr : Rgb + (Y - 1) * RowBytes,
             RowBytes, &Filtered[(Y - First) * Stride]);
    Strips[First / Each] = stripOf(Filtered, End == Rows);
  });

  using namespace std::string_literals;
  const auto EightBitRgb = "\x08\x02\0\0\0"s, Perceptual = "\0"s;
  std::string Out =
      "\x89PNG\r\n\x1a\n" +
      chunk("IHDR", bigEndian(static_cast<uLong>(Width)) +
                        bigEndian(static_cast<uLong>(Height)) + EightBitRgb) +
      chunk("sRGB", Perceptual) + chunk("IDAT", StreamHeader);
  uLong Checksum = 1;
  for (std::size_t N = 0; N < Strips.size(); ++N) {
    const Strip &S = Strips[N];
    if (S.Chunk.empty())
      return Error{"", "cannot encode the picture, expected memory for it",
                   ExitCode::LimitReached};
    Out += S.Chunk;
    const std::size_t OwnRows = std::min(Rows - N * Each, Each);
    Checksum = adler32_combine(Checksum, S.Checksum,
                               static_cast<z_off_t>(OwnRows * Stride));
  }
  return Out + chunk("IDAT", bigEndian(Checksum)) + chunk("IEND", "");
}

} // namespace vorion::splat
