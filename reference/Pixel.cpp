#include "Pixel.h"

#include "Walk.h"

namespace vorion::reference {

template <typename Real>
std::vector<Contributor<Real>>
contributors(const std::vector<Splat<Real>> &Splats, int Width, int Height,
             const Options &O, int X, int Y) {
  const TileWalk<Real> Walk(Splats, Width, Height, O);
  const TileGrid Grid(O.TileSize, Width, Height);
  const auto List = Walk.candidates(Grid.index(X / O.TileSize, Y / O.TileSize));
  std::vector<Contributor<Real>> Found;
  Walk.pixel(List, X, Y, [&](const Contribution<Real> &C) {
    Found.push_back({List[C.Entry].Index, C.Alpha, C.Alpha * C.T});
  });
  return Found;
}

template std::vector<Contributor<float>>
contributors(const std::vector<Splat<float>> &, int, int, const Options &, int,
             int);
template std::vector<Contributor<double>>
contributors(const std::vector<Splat<double>> &, int, int, const Options &, int,
             int);

} // namespace vorion::reference
