#include "Render.h"

#include "Walk.h"

#include <algorithm>
#include <cmath>

namespace vorion::reference {

template <typename Real> double Picture<Real>::doubtfulShare() const {
  const auto Doubtful = std::count_if(Doubts.begin(), Doubts.end(),
                                      [](uint8_t D) { return D != 0; });
  return Doubts.empty() ? 0 : double(Doubtful) / double(Doubts.size());
}

template <typename Real>
Picture<Real> blend(const std::vector<Splat<Real>> &Splats, int Width,
                    int Height, const Options &O, const Surface<Real> *Behind) {
  Picture<Real> P;
  P.Width = Width;
  P.Height = Height;
  const std::size_t Pixels =
      static_cast<std::size_t>(Width) * static_cast<std::size_t>(Height);
  P.Render.resize(Pixels);
  P.Transmittance.resize(Pixels);
  P.Doubts.resize(Pixels);
  P.Last.resize(Pixels);
  P.Stop.resize(Pixels);

  // Tiles write pixels of their own, and counts are integers, so that neither
  // the number of threads nor their order shows in the result.
  std::atomic<uint64_t> Blends = 0, Walked = 0, Saturated = 0;
  const glm::vec<3, Real> Background(O.Background[0], O.Background[1],
                                     O.Background[2]);
  const TileWalk<Real> Walk(Splats, Width, Height, O);
  forEachTile(Walk.tiles(), O.Threads, [&](std::size_t Tile) {
    const auto List = Walk.candidates(Tile);
    const Rect Area = Walk.pixels(Tile);
    uint64_t TileBlends = 0, TileWalked = 0, TileSaturated = 0;
    for (int Y = Area.Y0; Y < Area.Y1; ++Y)
      for (int X = Area.X0; X < Area.X1; ++X) {
        const auto At =
            static_cast<std::size_t>(Y) * static_cast<std::size_t>(Width) +
            static_cast<std::size_t>(X);
        const bool IsCovered = Behind && std::isfinite(Behind->Depths[At]);
        glm::vec<3, Real> Color(0);
        const PixelEnd<Real> End = Walk.pixel(
            List, X, Y,
            [&](const Contribution<Real> &C) {
              Color += List[C.Entry].Color * (C.Alpha * C.T);
              ++TileBlends;
            },
            Behind ? hidingKeys(*Behind, At, O.DepthBits) : HidingKeys{},
            Behind ? layersIn(*Behind, At) : std::span<const Layer<Real>>(),
            [&](const Layer<Real> &L, Real T) {
              Color += L.Color * (L.Alpha * T);
            });
        P.Render[At] =
            Color + End.T * (IsCovered ? Behind->Colors[At] : Background);
        P.Transmittance[At] = End.T;
        P.Doubts[At] = End.Doubts;
        if (Behind && !Behind->Doubtful.empty() && Behind->Doubtful[At])
          P.Doubts[At] |= DoubtSurface;
        P.Last[At] = End.Last;
        P.Stop[At] = End.Stop;
        TileWalked += End.Walked;
        TileSaturated += End.Stop >= 0;
      }
    Blends += TileBlends;
    Walked += TileWalked;
    Saturated += TileSaturated;
  });
  P.Blends = Blends;
  P.Walked = Walked;
  P.Saturated = Saturated;
  return P;
}

template <typename Real>
Picture<Real> render(const Gaussians<Real> &G, const Camera<Real> &C,
                     const Options &O, const Surface<Real> *Behind) {
  return blend(project(G, C, O), C.Width, C.Height, O, Behind);
}

template struct Picture<float>;
template struct Picture<double>;
template Picture<float> blend(const std::vector<Splat<float>> &, int, int,
                              const Options &, const Surface<float> *);
template Picture<double> blend(const std::vector<Splat<double>> &, int, int,
                               const Options &, const Surface<double> *);
template Picture<float> render(const Gaussians<float> &, const Camera<float> &,
                               const Options &, const Surface<float> *);
template Picture<double> render(const Gaussians<double> &,
                                const Camera<double> &, const Options &,
                                const Surface<double> *);

} // namespace vorion::reference
