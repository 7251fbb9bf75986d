#include "view/Judge.h"

#include "analyze/ToReference.h"
#include "io/LocalFrame.h"
#include "reference/Pixel.h"
#include "reference/Render.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <unordered_map>

namespace vorion::splat {

namespace {

/// Pixels of the picture in the box of \p S.
uint64_t pixelsOf(const reference::Splat<double> &S, const Camera &View) {
  const auto Along = [](double Mean, double Extent, int Side) {
    const double From = std::clamp(std::ceil(Mean - Extent - 0.5), 0.0,
                                   static_cast<double>(Side));
    const double To = std::clamp(std::floor(Mean + Extent - 0.5) + 1, 0.0,
                                 static_cast<double>(Side));
    return static_cast<uint64_t>(std::max(0.0, To - From));
  };
  return Along(S.Mean.x, S.Extent.x, View.Width) *
         Along(S.Mean.y, S.Extent.y, View.Height);
}

/// Tiles of \p O whose lists contain \p S. With a mesh they are no squares.
uint64_t tilesOf(const reference::Splat<double> &S, const RenderOptions &O,
                 const Camera &View) {
  const auto Of = [&](unsigned Side) {
    return reference::tilesOf(
        S, toReference(O.Reach),
        reference::TileGrid(static_cast<int>(Side), View.Width, View.Height));
  };
  const reference::Rect Across = Of(O.tileSize()), Down = Of(O.tileHeight());
  return static_cast<uint64_t>(Across.X1 - Across.X0) *
         static_cast<uint64_t>(Down.Y1 - Down.Y0);
}

/// \p View in the frame of \p S.
template <typename Real>
reference::Camera<Real> referenceCamera(const ShownScene &S,
                                        const Camera &View) {
  return toReference<Real>(relativeTo(View, S.File.Gaussians.Origin));
}

/// What the machine has drawn, as the reference has it.
reference::MeshView viewOf(const VisibleMesh &Seen) {
  reference::MeshView V;
  V.Depths.assign(Seen.Depth.begin(), Seen.Depth.end());
  V.Triangles.assign(Seen.Triangles.begin(), Seen.Triangles.end());
  const std::size_t Pixels = Seen.Depth.size();
  if (!Seen.LayerDepths.empty())
    V.Layers.resize(Pixels);
  for (std::size_t I = 0; I < Seen.LayerDepths.size(); ++I)
    if (Seen.LayerTriangles[I] >= 0)
      V.Layers[I % Pixels].push_back(
          {Seen.LayerDepths[I], Seen.LayerTriangles[I]});
  return V;
}

/// Of \p Seen, pixel \p At alone.
reference::MeshView pixelOf(const VisibleMesh &Seen, std::size_t At) {
  VisibleMesh Own{1, 1, {Seen.Depth[At]}, {Seen.Triangles[At]}, {}, {}};
  for (std::size_t I = At; I < Seen.LayerDepths.size();
       I += Seen.Depth.size()) {
    Own.LayerDepths.push_back(Seen.LayerDepths[I]);
    Own.LayerTriangles.push_back(Seen.LayerTriangles[I]);
  }
  return viewOf(Own);
}

/// The surfaces of a pixel whose opaque one is as deep as in \p Own, for the
/// order and the weights of its parts.
template <typename Real>
reference::Surface<Real> surfaceOf(const reference::MeshView &Own,
                                   std::span<const PixelTriangle> Layers) {
  reference::Surface<Real> S;
  S.Depths = Own.Depths;
  std::vector<reference::Layer<Real>> &To = S.Layers.emplace_back();
  for (const PixelTriangle &L : Layers)
    To.push_back({L.Depth, {}, static_cast<Real>(L.Alpha)});
  return S;
}

} // namespace

const reference::Mesh &Judge::meshOf(const ShownScene &S) {
  if (Converted != S.Surface) {
    Surface = toReference(*S.Surface, S.Light);
    Converted = S.Surface;
  }
  return Surface;
}

template <typename Real>
const reference::Gaussians<Real> &Judge::activated(const ShownScene &S) {
  if (Activated != S.Number) {
    InDouble = toReference<double>(S.File.Gaussians);
    InSingle = toReference<float>(S.File.Gaussians);
    Activated = S.Number;
  }
  if constexpr (std::is_same_v<Real, double>)
    return InDouble;
  else
    return InSingle;
}

Expected<std::shared_ptr<const std::vector<double>>>
Judge::picture(const std::shared_ptr<const ShownScene> &S, const Camera &View,
               const VisibleMesh *Seen, const std::function<bool()> &GiveUp) {
  if (!Lock.lockUnless(GiveUp))
    return superseded();
  const std::lock_guard Held(Lock, std::adopt_lock);
  if (Last.Picture && Last.Scene == S->Number && Last.View == View)
    return Last.Picture;
  if (GiveUp())
    return superseded();
  reference::Options O = toReference(S->File.DrawnAs);
  O.Near = double{S->Near.value_or(0)};
  const auto C = referenceCamera<double>(*S, View);
  std::optional<reference::Surface<double>> Behind;
  if (Seen)
    Behind = reference::surfaceOf(meshOf(*S), C, viewOf(*Seen));
  const auto Drawn = reference::render(activated<double>(*S), C, O,
                                       Behind ? &*Behind : nullptr);
  auto Picture = std::make_shared<std::vector<double>>();
  Picture->reserve(3 * Drawn.Render.size());
  for (const auto &Pixel : Drawn.Render)
    Picture->insert(Picture->end(), {Pixel.x, Pixel.y, Pixel.z});
  Last = {S->Number, View, Picture};
  return Last.Picture;
}

PixelParts Judge::pixel(const std::shared_ptr<const ShownScene> &S,
                        const ViewRequest &R, const VisibleMesh *Seen) {
  const std::lock_guard Held(Lock);
  const RenderOptions Chosen = optionsOf(R, *S);
  reference::Options O = toReference(Chosen);
  O.TileSize = static_cast<int>(Chosen.tileSize());
  const auto C = referenceCamera<double>(*S, R.View);
  reference::MeshView Own{{HUGE_VAL}, {-1}, {}, {}, {}};
  if (Seen)
    Own = pixelOf(*Seen, static_cast<std::size_t>(R.Y) *
                                 static_cast<std::size_t>(R.View.Width) +
                             static_cast<std::size_t>(R.X));
  // Layers, then the opaque triangle if there is one.
  std::vector<PixelTriangle> Triangles;
  const auto Add = [&](int64_t Triangle, double Depth) {
    const glm::dvec4 Rgba =
        reference::colorOf(meshOf(*S), C, static_cast<std::size_t>(Triangle),
                           {R.X + 0.5, R.Y + 0.5})
            .Rgba;
    Triangles.push_back({.Triangle = static_cast<std::size_t>(Triangle),
                         .Alpha = Rgba.w,
                         .Depth = Depth,
                         .Color = {Rgba.x, Rgba.y, Rgba.z}});
  };
  if (!Own.Layers.empty())
    for (const reference::SeenLayer &L : Own.Layers[0])
      Add(L.Triangle, L.Depth);
  const auto Found =
      [&]<typename Real>(const std::vector<reference::Splat<Real>> &Splats) {
        const auto Behind = surfaceOf<Real>(Own, Triangles);
        return reference::contributors(Splats, R.View.Width, R.View.Height, O,
                                       R.X, R.Y, &Behind);
      };
  const auto Exact = project(activated<double>(*S), C, O);
  const auto Rounded =
      project(activated<float>(*S), referenceCamera<float>(*S, R.View), O);
  std::unordered_map<int32_t, float> RoundedWeights;
  for (const auto &Part : Found(Rounded))
    if (!Part.IsLayer)
      RoundedWeights[Part.Index] = Part.Weight;
  PixelParts All;
  double Left = 1;
  for (const auto &Part : Found(Exact)) {
    Left *= 1 - Part.Alpha;
    const auto Index = static_cast<std::size_t>(Part.Index);
    if (Part.IsLayer) {
      Triangles[Index].Weight = Part.Weight;
      Triangles[Index].InFront = All.Gaussians.size();
      continue;
    }
    const reference::Splat<double> &Splat = Exact[Index];
    // A sphere's have copies behind them, beside the picture.
    const std::size_t Number = Index % S->File.Gaussians.size();
    PixelGaussian G{static_cast<int32_t>(Number),
                    Part.Weight,
                    Part.Alpha,
                    Splat.Depth,
                    {Splat.Color.x, Splat.Color.y, Splat.Color.z},
                    tilesOf(Splat, Chosen, R.View),
                    pixelsOf(Splat, R.View)};
    const auto Other = RoundedWeights.find(Part.Index);
    for (int K = 0; K < 3; ++K) {
      const double Other32 =
          Other == RoundedWeights.end()
              ? 0
              : double(Other->second) * double(Rounded[Index].Color[K]);
      G.Error =
          std::max(G.Error, std::abs(Other32 - Part.Weight * Splat.Color[K]));
    }
    All.Gaussians.push_back(G);
  }
  if (Own.Triangles[0] >= 0) {
    Add(Own.Triangles[0], Own.Depths[0]);
    Triangles.back().Alpha = 1;
    Triangles.back().Weight = Left;
    Triangles.back().InFront = All.Gaussians.size();
  }
  All.Triangles = std::move(Triangles);
  return All;
}

} // namespace vorion::splat
