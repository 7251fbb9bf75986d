#include "capture/Undistort.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace vorion::splat {
namespace {

/// A pixel between four: where they are along an axis, and the second's share.
struct Between {
  std::size_t First, Second;
  double Share;
};

/// \p At is a place from the picture's edge, px; nothing is outside.
std::optional<Between> between(double At, std::size_t Side) {
  if (!(At >= 0 && At <= static_cast<double>(Side)))
    return std::nullopt;
  const double Last = static_cast<double>(Side) - 1;
  const double Centre = std::clamp(At - 0.5, 0.0, Last);
  const auto First = static_cast<std::size_t>(Centre);
  return Between{First, std::min(First + 1, Side - 1),
                 Centre - static_cast<double>(First)};
}

/// The four pixels that one of the new picture is made of, with their shares.
struct Four {
  std::array<std::size_t, 4> Pixels;
  std::array<double, 4> Shares;
};

Four fourOf(const Between &X, const Between &Y, std::size_t Width) {
  return {{Y.First * Width + X.First, Y.First * Width + X.Second,
           Y.Second * Width + X.First, Y.Second * Width + X.Second},
          {(1 - X.Share) * (1 - Y.Share), X.Share * (1 - Y.Share),
           (1 - X.Share) * Y.Share, X.Share * Y.Share}};
}

std::byte rounded(double Value) {
  return static_cast<std::byte>(std::clamp(std::lround(Value), 0L, 255L));
}

/// The mean of four pixels, colours weighed by their alpha.
void mix(const Plane &From, const Four &Of, std::byte *To) {
  std::array<double, 3> Colour{};
  double Alpha = 0;
  for (std::size_t I = 0; I < 4; ++I) {
    const double Share = Of.Shares[I] * From.at(Of.Pixels[I], 3);
    for (std::size_t K = 0; K < 3; ++K)
      Colour[K] += Share * From.at(Of.Pixels[I], K);
    Alpha += Share;
  }
  if (!(Alpha > 0))
    return;
  for (std::size_t K = 0; K < 3; ++K)
    To[K] = rounded(Colour[K] / Alpha);
  To[3] = rounded(Alpha);
}

} // namespace

MaskedPlane undistorted(const MaskedPlane &From, const Camera &C,
                        const CameraModel &L) {
  const Plane &Old = From.Picture;
  const std::size_t Width = Old.Width, Height = Old.Height;
  MaskedPlane New{{Width, Height, std::vector<std::byte>(Old.Rgba.size())},
                  std::vector<uint8_t>(Old.pixels(), 0)};
  const double Reach = L.reach();
  for (std::size_t Row = 0; Row < Height; ++Row)
    for (std::size_t Column = 0; Column < Width; ++Column) {
      const double X = (static_cast<double>(Column) + 0.5 - C.Cx) / C.Fx;
      const double Y = (static_cast<double>(Row) + 0.5 - C.Cy) / C.Fy;
      if (X * X + Y * Y > Reach * Reach)
        continue;
      const auto [U, V] = L.distorted(X, Y);
      const auto Across = between(C.Fx * U + C.Cx, Width);
      const auto Down = between(C.Fy * V + C.Cy, Height);
      if (!Across || !Down)
        continue;
      const Four Of = fourOf(*Across, *Down, Width);
      const std::size_t Pixel = Row * Width + Column;
      mix(Old, Of, New.Picture.Rgba.data() + 4 * Pixel);
      New.Counts[Pixel] = 1;
      for (std::size_t I = 0; I < 4; ++I)
        if (!From.Counts.empty() && Of.Shares[I] > 0 &&
            From.Counts[Of.Pixels[I]] == 0)
          New.Counts[Pixel] = 0;
    }
  return New;
}

std::vector<uint8_t> shrinkCounts(const std::vector<uint8_t> &Counts,
                                  std::size_t FromWidth, std::size_t FromHeight,
                                  int Width, int Height) {
  if (Counts.empty())
    return {};
  const auto ToWidth = static_cast<std::size_t>(Width);
  const auto ToHeight = static_cast<std::size_t>(Height);
  std::vector<uint8_t> New(ToWidth * ToHeight, 1);
  const auto Begin = [](std::size_t I, std::size_t From, std::size_t To) {
    return I * From / To;
  };
  const auto End = [](std::size_t I, std::size_t From, std::size_t To) {
    return ((I + 1) * From + To - 1) / To;
  };
  for (std::size_t Row = 0; Row < ToHeight; ++Row)
    for (std::size_t Column = 0; Column < ToWidth; ++Column)
      for (std::size_t Y = Begin(Row, FromHeight, ToHeight);
           Y < End(Row, FromHeight, ToHeight); ++Y)
        for (std::size_t X = Begin(Column, FromWidth, ToWidth);
             X < End(Column, FromWidth, ToWidth); ++X)
          New[Row * ToWidth + Column] &= Counts[Y * FromWidth + X];
  return New;
}

} // namespace vorion::splat
