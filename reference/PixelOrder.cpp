#include "PixelOrder.h"

#include "Footprint.h"
#include "Walk.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <span>

namespace vorion::reference {
namespace {

/// How many pairs of \p List are not in its order; sorts it. Few are moved, so
/// that this takes little more than a look at each.
uint64_t sortAndCount(std::vector<Seen> &List) {
  uint64_t Turned = 0;
  for (std::size_t I = 1; I < List.size(); ++I)
    for (std::size_t J = I; J > 0 && List[J] < List[J - 1]; --J, ++Turned)
      std::swap(List[J], List[J - 1]);
  return Turned;
}

/// Gaussians that \p List, front to back, blends before it is full.
std::size_t blended(const std::vector<Seen> &List, const Options &O) {
  double T = 1;
  for (std::size_t I = 0; I < List.size(); ++I)
    if (T *= 1 - List[I].Alpha; isFull(T, O))
      return I;
  return List.size();
}

/// From the axes of the camera to those of a Gaussian, in standard deviations.
struct Whitening {
  glm::dmat3 Turn; ///< columns are the Gaussian's axes
  glm::dvec3 Scale, Mean;

  glm::dvec3 operator()(const glm::dvec3 &V) const {
    return glm::dvec3(glm::dot(Turn[0], V), glm::dot(Turn[1], V),
                      glm::dot(Turn[2], V)) /
           Scale;
  }
};

/// Of a disc as its limit has it.
constexpr double LeastScale = 1e-100;

} // namespace

Reordered blendInOrder(const std::vector<Splat<double>> &Splats, int Width,
                       int Height, const Options &O, const PixelDepth &Depth,
                       const Surface<double> *Behind) {
  Options Whole = O;
  Whole.Cutoff = 0; // what is full by one order may not be by another
  const TileWalk<double> Walk(Splats, Width, Height, Whole);
  Reordered R;
  R.Render.resize(static_cast<std::size_t>(Width) *
                  static_cast<std::size_t>(Height));
  R.Transmittance.resize(R.Render.size());
  std::atomic<uint64_t> Pairs = 0, Turned = 0;
  forEachTile(Walk.tiles(), O.Threads, [&](std::size_t Tile) {
    const auto List = Walk.candidates(Tile);
    const Rect P = Walk.pixels(Tile);
    std::vector<Seen> All, Front;
    for (int Y = P.Y0; Y < P.Y1; ++Y)
      for (int X = P.X0; X < P.X1; ++X) {
        All.clear();
        Walk.pixel(List, X, Y, [&](const Contribution<double> &C) {
          const int32_t Index = List[C.Entry].Index;
          All.push_back(
              {Depth(static_cast<std::size_t>(Index), X, Y), Index, C.Alpha});
        });
        Front.assign(All.begin(), All.begin() + static_cast<std::ptrdiff_t>(
                                                    blended(All, O)));
        Pairs += Front.size() * (Front.size() - 1) / 2;
        Turned += sortAndCount(Front);
        std::sort(All.begin(), All.end());
        const std::size_t Pixel =
            static_cast<std::size_t>(Y) * static_cast<std::size_t>(Width) +
            static_cast<std::size_t>(X);
        const bool IsCovered = Behind && std::isfinite(Behind->Depths[Pixel]);
        const std::span<const Layer<double>> Layers =
            Behind && !Behind->Layers.empty()
                ? std::span<const Layer<double>>(Behind->Layers[Pixel])
                : std::span<const Layer<double>>();
        double T = 1;
        glm::dvec3 Colour(0);
        auto Next = Layers.begin();
        const auto BlendLayersUpTo = [&](double Depth) {
          for (; Next != Layers.end() && Next->Depth <= Depth; ++Next) {
            Colour += Next->Color * (Next->Alpha * T);
            T *= 1 - Next->Alpha;
          }
        };
        for (const Seen &S : All) {
          if (IsCovered && S.Depth >= Behind->Depths[Pixel])
            break;
          BlendLayersUpTo(S.Depth);
          if (isFull(T * (1 - S.Alpha), O))
            break;
          Colour +=
              Splats[static_cast<std::size_t>(S.Index)].Color * (S.Alpha * T);
          T *= 1 - S.Alpha;
        }
        BlendLayersUpTo(std::numeric_limits<double>::infinity());
        R.Render[Pixel] =
            Colour + T * (IsCovered
                              ? Behind->Colors[Pixel]
                              : glm::dvec3(O.Background[0], O.Background[1],
                                           O.Background[2]));
        R.Transmittance[Pixel] = T;
      }
  });
  R.Pairs = Pairs;
  R.Turned = Turned;
  return R;
}

PixelDepth depthAlongRay(const Gaussians<double> &G, const Camera<double> &C) {
  assert(C.Optics.isPinhole() && "a ray for each pixel");
  auto All = std::make_shared<std::vector<Whitening>>();
  All->reserve(G.size());
  for (std::size_t I = 0; I < G.size(); ++I)
    All->push_back({multiply(C.Rotation, rotation(G.Quats[I])),
                    glm::max(G.Scales[I], glm::dvec3(LeastScale)),
                    multiply(C.Rotation, G.Means[I]) + C.Translation});
  return [All, C](std::size_t I, int X, int Y) {
    const glm::dvec3 Ray((X + 0.5 - C.Principal.x) / C.Focal.x,
                         (Y + 0.5 - C.Principal.y) / C.Focal.y, 1);
    const Whitening &W = (*All)[I];
    const glm::dvec3 R = W(Ray);
    return glm::dot(R, W(W.Mean)) / glm::dot(R, R);
  };
}

} // namespace vorion::reference
