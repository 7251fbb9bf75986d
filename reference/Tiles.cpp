#include "Tiles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace vorion::reference {
namespace {

/// \p Value clamped to [0, Most] before it becomes an integer; NaN is 0.
template <typename Real> int clampedFloor(Real Value, int Most) {
  const Real Floor = std::floor(Value);
  if (!(Floor > 0))
    return 0;
  return Floor < Real(Most) ? static_cast<int>(Floor) : Most;
}

} // namespace

TileGrid::TileGrid(int Size, int Width, int Height)
    : Size(Size), Width(Width), Height(Height),
      Columns((Width + Size - 1) / Size), Rows((Height + Size - 1) / Size) {}

template <typename Real>
Rect officialPixels(const glm::vec<2, Real> &Mean, Real Radius, int Width,
                    int Height) {
  constexpr int Tile = 16;
  const TileGrid Grid(Tile, Width, Height);
  const glm::vec<2, Real> M = Mean - Real(0.5);
  const auto First = [&](Real Value, int Count, int Pixels) {
    return std::min(clampedFloor((Value - Radius) / Tile, Count) * Tile,
                    Pixels);
  };
  const auto End = [&](Real Value, int Count, int Pixels) {
    return std::min(clampedFloor((Value + Radius + (Tile - 1)) / Tile, Count) *
                        Tile,
                    Pixels);
  };
  return {First(M.x, Grid.Columns, Width), First(M.y, Grid.Rows, Height),
          End(M.x, Grid.Columns, Width), End(M.y, Grid.Rows, Height)};
}

template <typename Real>
Rect tilesOf(const Splat<Real> &S, Support Reach, const TileGrid &Grid) {
  if (Reach == Support::Official16) {
    const Rect P = officialPixels(S.Mean, S.Extent.x, Grid.Columns * Grid.Size,
                                  Grid.Rows * Grid.Size);
    if (P.X0 >= P.X1 || P.Y0 >= P.Y1)
      return {};
    return {P.X0 / Grid.Size, P.Y0 / Grid.Size,
            (P.X1 + Grid.Size - 1) / Grid.Size,
            (P.Y1 + Grid.Size - 1) / Grid.Size};
  }
  // A NaN fails either test.
  if (!(S.Mean.x - S.Extent.x < Real(Grid.Width)) ||
      !(S.Mean.y - S.Extent.y < Real(Grid.Height)))
    return {};
  const auto First = [&](Real Low, int Count) {
    return clampedFloor(Low / Real(Grid.Size), Count);
  };
  const auto End = [&](Real High, int Count) {
    return clampedFloor(std::floor(High / Real(Grid.Size)) + 1, Count);
  };
  return {First(S.Mean.x - S.Extent.x, Grid.Columns),
          First(S.Mean.y - S.Extent.y, Grid.Rows),
          End(S.Mean.x + S.Extent.x, Grid.Columns),
          End(S.Mean.y + S.Extent.y, Grid.Rows)};
}

uint64_t TileLists::pairs() const {
  uint64_t Sum = 0;
  for (const auto &List : Lists)
    Sum += List.size();
  return Sum;
}

uint32_t depthBits(double Depth) {
  return std::bit_cast<uint32_t>(static_cast<float>(Depth));
}

uint32_t orderKey(double Depth, int DepthBits) {
  return depthBits(Depth) >> (32 - DepthBits);
}

uint64_t sortKey(std::size_t Tile, double Depth) {
  return uint64_t(Tile) << 32 | depthBits(Depth);
}

template <typename Real>
std::vector<uint32_t> depthOrder(const std::vector<Splat<Real>> &Splats,
                                 int DepthBits) {
  std::vector<uint32_t> Order;
  for (std::size_t I = 0; I < Splats.size(); ++I)
    if (Splats[I].Visible)
      Order.push_back(static_cast<uint32_t>(I));
  std::sort(Order.begin(), Order.end(), [&](uint32_t A, uint32_t B) {
    return std::pair(orderKey(Splats[A].Depth, DepthBits), A) <
           std::pair(orderKey(Splats[B].Depth, DepthBits), B);
  });
  return Order;
}

template <typename Real>
TileLists tileLists(const std::vector<Splat<Real>> &Splats, Support Reach,
                    int TileSize, int Width, int Height) {
  TileLists T{TileGrid(TileSize, Width, Height), {}};
  T.Lists.resize(T.Grid.count());
  for (const uint32_t I : depthOrder(Splats)) {
    const Rect R = tilesOf(Splats[I], Reach, T.Grid);
    for (int Y = R.Y0; Y < R.Y1; ++Y)
      for (int X = R.X0; X < R.X1; ++X)
        T.Lists[T.Grid.index(X, Y)].push_back(I);
  }
  return T;
}

template Rect tilesOf(const Splat<float> &, Support, const TileGrid &);
template Rect tilesOf(const Splat<double> &, Support, const TileGrid &);
template Rect officialPixels(const glm::vec<2, float> &, float, int, int);
template Rect officialPixels(const glm::vec<2, double> &, double, int, int);
template TileLists tileLists(const std::vector<Splat<float>> &, Support, int,
                             int, int);
template TileLists tileLists(const std::vector<Splat<double>> &, Support, int,
                             int, int);
template std::vector<uint32_t> depthOrder(const std::vector<Splat<float>> &,
                                          int);
template std::vector<uint32_t> depthOrder(const std::vector<Splat<double>> &,
                                          int);

} // namespace vorion::reference
