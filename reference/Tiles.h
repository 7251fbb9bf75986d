/// The tiles that a Gaussian covers, and the depth-sorted list of each tile.
#pragma once

#include "Projection.h"

#include <cstdint>
#include <vector>

namespace vorion::reference {

/// Columns X0 <= x < X1 and rows Y0 <= y < Y1 of tiles or pixels.
struct Rect {
  int X0 = 0, Y0 = 0, X1 = 0, Y1 = 0;
  bool contains(int X, int Y) const {
    return X0 <= X && X < X1 && Y0 <= Y && Y < Y1;
  }
};

/// The partition of a picture into square tiles; the last ones may be partial.
struct TileGrid {
  int Size = 16; ///< pixels
  int Width = 0; ///< of the picture, pixels
  int Height = 0;
  int Columns = 0;
  int Rows = 0;
  TileGrid(int Size, int Width, int Height);

  /// Number of tiles in the grid, and the row-major index of one.
  std::size_t count() const { return index(0, Rows); }
  std::size_t index(int Column, int Row) const {
    return std::size_t(Row) * std::size_t(Columns) + std::size_t(Column);
  }
};

/// The tiles whose area [t Size, (t + 1) Size) meets the box mean +- extent:
/// floor((mean - extent) / Size) <= t < floor((mean + extent) / Size) + 1,
/// clamped to the grid while still in floating point; none if the box starts
/// after the picture's last pixel, even if the last tile extends farther. For
/// Official16 the tiles that contain a pixel of \c officialPixels.
template <typename Real>
Rect tilesOf(const Splat<Real> &S, Support Reach, const TileGrid &Grid);

/// The pixels of the 16x16 tiles that INRIA's square of half side \p Radius
/// touches: floor((m - r) / 16) <= t < floor((m + r + 15) / 16) with
/// m = mean - 0.5, as INRIA's pixels have their centres at integers.
template <typename Real>
Rect officialPixels(const glm::vec<2, Real> &Mean, Real Radius, int Width,
                    int Height);

/// The list of every tile, row by row.
struct TileLists {
  TileGrid Grid;
  /// Gaussians of each tile front to back: by the bits of z in fp32, ties by
  /// index, as in a stable sort by tile << 32 | depth bits.
  std::vector<std::vector<uint32_t>> Lists;

  uint64_t pairs() const;
};

template <typename Real>
TileLists tileLists(const std::vector<Splat<Real>> &Splats, Support Reach,
                    int TileSize, int Width, int Height);

/// Visible Gaussians front to back, as in the lists; by the leading \p
/// DepthBits of their depths, ties by index.
template <typename Real>
std::vector<uint32_t> depthOrder(const std::vector<Splat<Real>> &Splats,
                                 int DepthBits = 32);

/// The bits of \p Depth > 0 in fp32, which sort in the order of the values.
uint32_t depthBits(double Depth);

/// The leading \p DepthBits (1 to 32) of that.
uint32_t orderKey(double Depth, int DepthBits);

/// The sort key of an entry: tile << 32 | depth bits.
uint64_t sortKey(std::size_t Tile, double Depth);

} // namespace vorion::reference
