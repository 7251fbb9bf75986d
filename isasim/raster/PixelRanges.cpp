#include "raster/PixelRanges.h"

#include "raster/CommandInput.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace vorion::raster {

PixelRanges::PixelRanges(const Job &J, RasterMemory &Memory, TileBuffer &Of)
    : Tile(Of), Width(J.Width), Height(J.Height),
      KeepsSaturated(J.KeepsSaturated) {
  if (J.rangeWords() == 0)
    return;
  const auto Word = [&](const std::byte *Row, unsigned Column, uint32_t None) {
    if (Row)
      std::memcpy(&None, Row + Column * sizeof(None), sizeof(None));
    return None - std::min(None, J.LimitFirst);
  };
  for (unsigned Y = 0; Y != J.Height; ++Y) {
    const std::byte *From = J.StartsLate ? fromRow(J, Memory, Y) : nullptr;
    const std::byte *To = J.IsLimited ? limitRow(J, Memory, Y) : nullptr;
    for (unsigned X = 0; X != J.Width; ++X) {
      const Turn Begin{Word(From, X, 0), static_cast<uint8_t>(Y),
                       static_cast<uint8_t>(X)};
      Turn End = Begin;
      End.Entry = Word(To, X, std::numeric_limits<uint32_t>::max());
      if (std::signbit(Tile.T[Y * TileBuffer::Stride + X]))
        continue;
      if (Begin.Entry == 0 && End.Entry != 0) {
        Ends.push_back(End);
        continue;
      }
      setOpen(Begin, false);
      if (Begin.Entry < End.Entry) {
        Begins.push_back(Begin);
        Ends.push_back(End);
      }
    }
  }
  std::ranges::sort(Begins, std::greater(), &Turn::Entry);
  std::ranges::sort(Ends, std::greater(), &Turn::Entry);
}

void PixelRanges::setOpen(const Turn &Pixel, bool IsOpen) {
  float &T = Tile.T[Pixel.Row * TileBuffer::Stride + Pixel.Column];
  const int Change = IsOpen ? 1 : -1;
  T = -T;
  Tile.RowLive[Pixel.Row] += Change;
  Tile.Live += Change;
  Outside[Pixel.Row] ^= uint64_t{1} << Pixel.Column;
}

uint32_t PixelRanges::first(uint32_t Count) const {
  if (Tile.Live != 0)
    return 0;
  return Begins.empty() ? Count : std::min(Count, Begins.back().Entry);
}

bool PixelRanges::goTo(uint32_t Entry) {
  for (; !Begins.empty() && Begins.back().Entry <= Entry; Begins.pop_back())
    setOpen(Begins.back(), true);
  for (; !Ends.empty() && Ends.back().Entry <= Entry; Ends.pop_back())
    if (const Turn &End = Ends.back();
        !std::signbit(Tile.T[End.Row * TileBuffer::Stride + End.Column]))
      setOpen(End, false);
  return left() != 0;
}

uint64_t PixelRanges::leftOf(unsigned Row) const {
  uint64_t Left = 0;
  for (unsigned X = 0; Row < Height && X != Width; ++X)
    if (!std::signbit(Tile.T[Row * TileBuffer::Stride + X]))
      Left |= uint64_t{1} << X;
  for (const Turn &Begin : Begins)
    if (Begin.Row == Row)
      Left |= uint64_t{1} << Begin.Column;
  return Left;
}

Pixel PixelRanges::written(unsigned Row, unsigned Column) const {
  const unsigned At = Row * TileBuffer::Stride + Column;
  const bool IsOutside = (Outside[Row] >> Column & 1) != 0;
  const bool IsMarked =
      KeepsSaturated && !IsOutside && std::signbit(Tile.T[At]);
  const float T = std::fabs(Tile.T[At]);
  return {Tile.R[At], Tile.G[At], Tile.B[At], IsMarked ? -T : T};
}

} // namespace vorion::raster
