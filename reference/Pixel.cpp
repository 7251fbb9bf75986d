#include "Pixel.h"

#include "Walk.h"

namespace vorion::reference {

namespace {

template <typename Real>
std::vector<Contributor<Real>>
walked(const TileWalk<Real> &Walk, const std::vector<Candidate<Real>> &List,
       int X, int Y, const HidingKeys &Hidden = {},
       std::span<const Layer<Real>> Layers = {}) {
  std::vector<Contributor<Real>> Found;
  Walk.pixel(
      List, X, Y,
      [&](const Contribution<Real> &C) {
        Found.push_back({List[C.Entry].Index, C.Alpha, C.Alpha * C.T});
      },
      Hidden, Layers,
      [&](const Layer<Real> &L, Real T) {
        Found.push_back({static_cast<int32_t>(&L - Layers.data()), L.Alpha,
                         L.Alpha * T, /*IsLayer=*/true});
      });
  return Found;
}

} // namespace

template <typename Real>
std::vector<Contributor<Real>>
contributors(const std::vector<Splat<Real>> &Splats, int Width, int Height,
             const Options &O, int X, int Y, const Surface<Real> *Behind) {
  const TileWalk<Real> Walk(Splats, Width, Height, O);
  const TileGrid Grid(O.TileSize, Width, Height);
  const auto List = Walk.candidates(Grid.index(X / O.TileSize, Y / O.TileSize));
  return Behind ? walked(Walk, List, X, Y, hidingKeys(*Behind, 0, O.DepthBits),
                         layersIn(*Behind, 0))
                : walked(Walk, List, X, Y);
}

template <typename Real>
std::vector<std::vector<Contributor<Real>>>
contributorsOfAll(const std::vector<Splat<Real>> &Splats, int Width, int Height,
                  const Options &O) {
  const TileWalk<Real> Walk(Splats, Width, Height, O);
  std::vector<std::vector<Contributor<Real>>> All(
      static_cast<std::size_t>(Width) * static_cast<std::size_t>(Height));
  for (std::size_t Tile = 0; Tile < Walk.tiles(); ++Tile) {
    const auto List = Walk.candidates(Tile);
    const Rect R = Walk.pixels(Tile);
    for (int Y = R.Y0; Y < R.Y1; ++Y)
      for (int X = R.X0; X < R.X1; ++X)
        All[static_cast<std::size_t>(Y) * static_cast<std::size_t>(Width) +
            static_cast<std::size_t>(X)] = walked(Walk, List, X, Y);
  }
  return All;
}

template std::vector<Contributor<float>>
contributors(const std::vector<Splat<float>> &, int, int, const Options &, int,
             int, const Surface<float> *);
template std::vector<Contributor<double>>
contributors(const std::vector<Splat<double>> &, int, int, const Options &, int,
             int, const Surface<double> *);
template std::vector<std::vector<Contributor<float>>>
contributorsOfAll(const std::vector<Splat<float>> &, int, int, const Options &);
template std::vector<std::vector<Contributor<double>>>
contributorsOfAll(const std::vector<Splat<double>> &, int, int,
                  const Options &);

} // namespace vorion::reference
