#include "view/Judge.h"

#include "analyze/ToReference.h"
#include "io/LocalFrame.h"
#include "reference/Pixel.h"
#include "reference/Render.h"

#include <algorithm>
#include <cmath>
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

uint64_t tilesOf(const reference::Splat<double> &S, const reference::Options &O,
                 const Camera &View) {
  const reference::Rect R = reference::tilesOf(
      S, O.Reach, reference::TileGrid(O.TileSize, View.Width, View.Height));
  return static_cast<uint64_t>(R.X1 - R.X0) *
         static_cast<uint64_t>(R.Y1 - R.Y0);
}

/// \p View in the frame of \p S.
template <typename Real>
reference::Camera<Real> referenceCamera(const ShownScene &S,
                                        const Camera &View) {
  return toReference<Real>(relativeTo(View, S.File.Gaussians.Origin));
}

} // namespace

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
               const std::function<bool()> &GiveUp) {
  if (!Lock.lockUnless(GiveUp))
    return superseded();
  const std::lock_guard Held(Lock, std::adopt_lock);
  if (Last.Picture && Last.Scene == S->Number && Last.View == View)
    return Last.Picture;
  if (GiveUp())
    return superseded();
  reference::Options O = toReference(S->File.DrawnAs);
  O.Near = double{S->Near.value_or(0)};
  const auto Drawn = reference::render(activated<double>(*S),
                                       referenceCamera<double>(*S, View), O);
  auto Picture = std::make_shared<std::vector<double>>();
  Picture->reserve(3 * Drawn.Render.size());
  for (const auto &Pixel : Drawn.Render)
    Picture->insert(Picture->end(), {Pixel.x, Pixel.y, Pixel.z});
  Last = {S->Number, View, Picture};
  return Last.Picture;
}

std::vector<PixelGaussian>
Judge::pixel(const std::shared_ptr<const ShownScene> &S, const ViewRequest &R) {
  const std::lock_guard Held(Lock);
  const RenderOptions Chosen = optionsOf(R, *S);
  reference::Options O = toReference(Chosen);
  O.TileSize = static_cast<int>(Chosen.RasterTile);
  const auto Found =
      [&]<typename Real>(const std::vector<reference::Splat<Real>> &Splats) {
        return reference::contributors(Splats, R.View.Width, R.View.Height, O,
                                       R.X, R.Y);
      };
  const auto Exact =
      project(activated<double>(*S), referenceCamera<double>(*S, R.View), O);
  const auto Rounded =
      project(activated<float>(*S), referenceCamera<float>(*S, R.View), O);
  std::unordered_map<int32_t, float> RoundedWeights;
  for (const auto &C : Found(Rounded))
    RoundedWeights[C.Index] = C.Weight;
  std::vector<PixelGaussian> All;
  for (const auto &C : Found(Exact)) {
    const auto Index = static_cast<std::size_t>(C.Index);
    const reference::Splat<double> &Splat = Exact[Index];
    // A sphere's have copies behind them, beside the picture.
    const std::size_t Own = Index % S->File.Gaussians.size();
    PixelGaussian G{static_cast<int32_t>(Own),
                    C.Weight,
                    C.Alpha,
                    Splat.Depth,
                    {Splat.Color.x, Splat.Color.y, Splat.Color.z},
                    tilesOf(Splat, O, R.View),
                    pixelsOf(Splat, R.View)};
    const auto Other = RoundedWeights.find(C.Index);
    for (int K = 0; K < 3; ++K) {
      const double Other32 =
          Other == RoundedWeights.end()
              ? 0
              : double(Other->second) * double(Rounded[Index].Color[K]);
      G.Error =
          std::max(G.Error, std::abs(Other32 - C.Weight * Splat.Color[K]));
    }
    All.push_back(G);
  }
  return All;
}

} // namespace vorion::splat
