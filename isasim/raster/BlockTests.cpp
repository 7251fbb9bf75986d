#include "raster/BlockTests.h"

#include "raster/RasterTables.h"

#include <algorithm>
#include <cmath>

namespace vorion::raster {

namespace {

/// Exponential units are off by less than this in their logarithm
/// (ExpVector.h).
constexpr double ExpMargin = 0.0625;
/// Roundings of a pixel's power are below this share of its parts.
constexpr double Rounding = 1e-6;

struct Range {
  double Low, High;
  double nearest(double To) const { return std::clamp(To, Low, High); }
};

/// Columns or rows of the tile, both ends included.
struct Ends {
  unsigned First, Last;
};

/// The quadratic form of a Gaussian, whose alpha is opacity exp(-form / 2), and
/// the largest value of it that is blended.
class Ellipse {
public:
  Ellipse(const Gaussian &G, float MinAlpha)
      : A(G.Conic[0]), B(G.Conic[1]), C(G.Conic[2]),
        Most(2 * (std::log(double{G.Opacity} / MinAlpha) + ExpMargin)) {}

  /// Whether a point of the rectangle, which is relative to the mean, may be
  /// blended. The form is convex: its least value is at the mean or on an edge.
  bool touches(Range X, Range Y) const {
    // No ellipse: whatever the record is, nothing is left out.
    if (!(A > 0 && C > 0 && A * C > B * B) || !std::isfinite(Most))
      return true;
    const double NearX = X.nearest(0), NearY = Y.nearest(0);
    // The nearest edges decide; the mean's own column and row are among them.
    return isInside(NearX, Y.nearest(-B * NearX / C)) ||
           isInside(X.nearest(-B * NearY / A), NearY);
  }

private:
  bool isInside(double X, double Y) const {
    const double Squares = A * X * X + C * Y * Y, Mixed = 2 * B * X * Y;
    return Squares + Mixed <= Most + Rounding * (Squares + std::abs(Mixed));
  }
  double A, B, C, Most;
};

} // namespace

void BlockTests::close(unsigned X, unsigned Y, const TileBuffer &Tile) {
  for (unsigned Row = Y * Side; Row != (Y + 1) * Side; ++Row)
    for (unsigned Column = X * Side; Column != (X + 1) * Side; ++Column)
      // Pixels beyond the tile's edge are never open.
      if (!std::isnan(Tile.CentreX[Column]) && !std::isnan(Tile.CentreY[Row]) &&
          !std::signbit(Tile.T[Row * TileBuffer::Stride + Column]))
        return;
  Closed[Y] |= static_cast<uint16_t>(1U << X);
}

/// \p IsOut: whether all between columns and between rows is outside.
template <typename Outside>
BlockWork BlockTests::count(const BoxWork &Box, const TileBuffer &Tile,
                            Outside IsOut) {
  const unsigned EndX = Box.X + Box.Width, EndY = Box.Y + Box.Height;
  BlockWork Left{0, 0};
  for (unsigned Y = Box.Y / Side; Y * Side < EndY; ++Y) {
    const unsigned FirstY = std::max<unsigned>(Box.Y, Y * Side),
                   LastY = std::min(EndY, (Y + 1) * Side) - 1;
    for (unsigned X = Box.X / Side; X * Side < EndX; ++X) {
      const unsigned FirstX = std::max<unsigned>(Box.X, X * Side),
                     LastX = std::min(EndX, (X + 1) * Side) - 1;
      if (Which & ClosedBlock) {
        if (isClosed(X, Y))
          continue;
        // For the Gaussians behind this one, which found it open.
        close(X, Y, Tile);
      }
      if ((Which & OutsideEllipse) && IsOut({FirstX, LastX}, {FirstY, LastY}))
        continue;
      ++Left.Blocks;
      Left.Pixels = static_cast<uint16_t>(
          Left.Pixels + (LastX - FirstX + 1) * (LastY - FirstY + 1));
    }
  }
  return Left;
}

BlockWork BlockTests::count(const Gaussian &G, const BoxWork &Box,
                            float MinAlpha, const TileBuffer &Tile) {
  const Ellipse E(G, MinAlpha);
  return count(Box, Tile, [&](Ends X, Ends Y) {
    return !E.touches({double{Tile.CentreX[X.First]} - G.Mean[0],
                       double{Tile.CentreX[X.Last]} - G.Mean[0]},
                      {double{Tile.CentreY[Y.First]} - G.Mean[1],
                       double{Tile.CentreY[Y.Last]} - G.Mean[1]});
  });
}

BlockWork BlockTests::count(const RayGaussian &, const BoxWork &Box, float,
                            const TileBuffer &Tile) {
  return count(Box, Tile, [](Ends, Ends) { return false; });
}

} // namespace vorion::raster
