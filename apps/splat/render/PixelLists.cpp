#include "render/PixelLists.h"

#include "vorion/support/Parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorion::splat {

namespace {

/// A Gaussian that a pixel blends.
struct Contribution {
  uint32_t Record;
  float Weight;
  float Behind; ///< transmittance behind it
  float Deeper; ///< the depth there by that of the mean
};

/// What a pixel sees of a Gaussian.
struct Sight {
  float Power;      ///< of its density; no number where it is not seen
  float Deeper = 1; ///< as in Contribution
};

/// \p Px and \p Py are the pixel's centre.
Sight sightOf(const splat_gaussian &G, float Px, float Py, RendererKind,
              unsigned) {
  const float Dx = G.mean[0] - Px, Dy = G.mean[1] - Py;
  if (!(std::abs(Dx) <= G.extent[0]))
    return {std::numeric_limits<float>::quiet_NaN()};
  return {-0.5F * (G.conic[0] * Dx * Dx + G.conic[2] * Dy * Dy) -
          G.conic[1] * Dx * Dy};
}

Sight sightOf(const splat_ray_gaussian &G, float Px, float Py,
              RendererKind Kind, unsigned Degree) {
  constexpr float None = std::numeric_limits<float>::quiet_NaN();
  const float X = Px - 0.5F - static_cast<float>(G.first & 0xFFFF);
  const float Y = Py - 0.5F - static_cast<float>(G.first >> 16);
  if (X < 0 || Px - 0.5F > static_cast<float>(G.last & 0xFFFF))
    return {None};
  const float Dx = X - G.mean[0], Dy = Y - G.mean[1];
  const float U = G.factor[0] * Dx + G.factor[1] * Dy;
  const float V = G.factor[2] * Dy;
  const float Beside = U * U + V * V;
  const float L = (1 + G.slope[0] * Dx) + G.slope[1] * Dy;
  const float Far = L * L + G.near * Beside;
  const float Q = L > 0 ? Beside / Far : None;
  if (const float Blurred = 2 * (Dx * Dx + Dy * Dy);
      Kind == RendererKind::Surfel && !(Q <= Blurred))
    return {-0.5F * Blurred};
  return {Degree == 4 ? -1.0F / 18.0F * Q * Q : -0.5F * Q, L / Far};
}

/// Whether its box has the row of pixels with the centres at \p Py.
bool hasRow(const splat_gaussian &G, float Py) {
  return std::abs(G.mean[1] - Py) <= G.extent[1];
}
bool hasRow(const splat_ray_gaussian &G, float Py) {
  const float Row = Py - 0.5F;
  return Row >= static_cast<float>(G.first >> 16) &&
         Row <= static_cast<float>(G.last >> 16);
}

/// How the lists are gone through.
struct Walk {
  const PixelLists &Lists;
  float Cutoff, LeastAlpha;
  bool StopsAtEqual;
  RendererKind Kind;
  unsigned Degree;

  Walk(const PixelLists &Of, const RenderOptions &O)
      : Lists(Of), Cutoff(O.Cutoff),
        LeastAlpha(static_cast<float>(O.AlphaCutoff) / 255.0F),
        StopsAtEqual(O.Convention == Rules::Gsplat), Kind(O.Kind),
        Degree(O.FalloffDegree) {}

  /// The first record of the window of pixel (\p X, \p Y), and a coordinate of
  /// its centre there (kernels/window.h).
  std::size_t firstAt(uint32_t X, uint32_t Y) const {
    const splat_windows &W = Lists.Windows;
    const uint32_t Window = (Y >> W.bits) * W.columns + (X >> W.bits);
    return std::size_t{Window} * W.stride;
  }
  float inWindow(uint32_t V) const {
    return static_cast<float>(V & ((1U << Lists.Windows.bits) - 1)) + 0.5F;
  }

  template <typename Function>
  void pixel(const std::vector<uint32_t> &Row, uint32_t X, uint32_t Y,
             Function Blend) const {
    const std::size_t First = firstAt(X, Y);
    if (hasRayRecords(Kind))
      pixel(Lists.Rays.data() + First, Row, X, Y, Blend);
    else
      pixel(Lists.Records.data() + First, Row, X, Y, Blend);
  }

  /// Calls \p Work with the row and the place of every pixel; the calls share
  /// nothing.
  template <typename Function> void eachPixel(Function Work) const {
    const auto [Width, Height] = Lists.Size;
    const auto [Across, Down] = Lists.TileSize;
    const uint32_t Columns = (Width + Across - 1) / Across;
    inParallel(Lists.Ranges.size(), [&](std::size_t Number) {
      const auto Tile = static_cast<uint32_t>(Number);
      const uint32_t X0 = Tile % Columns * Across, Y0 = Tile / Columns * Down;
      std::vector<uint32_t> Row;
      for (uint32_t Y = Y0; Y < std::min(Y0 + Down, Height); ++Y) {
        const std::size_t First = firstAt(X0, Y);
        if (hasRayRecords(Kind))
          takeRow(Lists.Rays.data() + First, Tile, Y, Row);
        else
          takeRow(Lists.Records.data() + First, Tile, Y, Row);
        for (uint32_t X = X0; X < std::min(X0 + Across, Width); ++X)
          Work(Row, X, Y);
      }
    });
  }

private:
  /// Calls \p Blend for what pixel (\p X, \p Y) blends of \p Row, which has
  /// all of its row, front to back, in the operations of docs/abi.md
  /// ("Rasterizer").
  template <typename Record, typename Function>
  void pixel(const Record *Records, const std::vector<uint32_t> &Row,
             uint32_t X, uint32_t Y, Function Blend) const {
    const float Px = inWindow(X), Py = inWindow(Y);
    float T = 1;
    for (const uint32_t Number : Row) {
      const Record &G = Records[Number];
      const auto [Power, Deeper] = sightOf(G, Px, Py, Kind, Degree);
      if (!(Power <= 0))
        continue;
      // Through double: correctly rounded, but for rare ties.
      const float Alpha = std::min(
          0.99F,
          G.opacity * static_cast<float>(std::exp(static_cast<double>(Power))));
      if (!(Alpha >= LeastAlpha))
        continue;
      const float Next = T * (1 - Alpha);
      if (StopsAtEqual ? Next <= Cutoff : Next < Cutoff)
        return;
      Blend(Contribution{Number, Alpha * T, Next, Deeper});
      T = Next;
    }
  }

  /// What of \p Tile's list reaches row \p Y.
  template <typename Record>
  void takeRow(const Record *Records, uint32_t Tile, uint32_t Y,
               std::vector<uint32_t> &Row) const {
    const float Py = inWindow(Y);
    Row.clear();
    for (uint32_t At = Lists.Ranges[Tile][0]; At < Lists.Ranges[Tile][1]; ++At)
      if (hasRow(Records[Lists.List[At]], Py))
        Row.push_back(Lists.List[At]);
  }
};

} // namespace

PixelLists readLists(Launcher &Launch, const Frame &F, const RenderOptions &O) {
  PixelLists L;
  L.Size = {F.View.size[0], F.View.size[1]};
  L.TileSize = {O.tileSize(), O.tileHeight()};
  L.Stride = F.stride();
  if (hasRayRecords(O.Kind)) {
    L.Rays.resize(F.drawn());
  } else if (F.WindowCount != 0) {
    L.Windows = F.Windows;
    L.Records.resize(1 + std::size_t{F.WindowCount} * F.Windows.stride);
  } else {
    L.Records.resize(F.drawn());
  }
  L.Depths.resize(F.drawn());
  L.List.resize(F.Pairs);
  L.Ranges.resize(F.tiles());
  if (hasRayRecords(O.Kind))
    Launch.read("projected Gaussians", L.Rays.data(), F.Blended,
                sizeof(splat_ray_gaussian) * L.Rays.size());
  else
    Launch.read("projected Gaussians", L.Records.data(), F.Blended,
                sizeof(splat_gaussian) * L.Records.size());
  if (F.WindowCount != 0)
    L.Records.erase(L.Records.begin());
  Launch.read("depths", L.Depths.data(), F.Depths.Keys, 4 * L.Depths.size());
  Launch.read("Gaussians of pairs", L.List.data(), F.List, 4 * L.List.size());
  Launch.read("tile ranges", L.Ranges.data(), F.Ranges, 8 * L.Ranges.size());
  for (uint32_t &Entry : L.List)
    Entry &= ~SPANS_TILES;
  return L;
}

bool hasPixelLists(const RenderOptions &O) {
  return O.Exponential == ExpUnit::Exact && O.Arithmetic == BlendUnit::Fp32 &&
         O.ZTiles == 1 && O.Order == PixelOrder::Depth;
}

Contributors topContributors(const PixelLists &L, const RenderOptions &O,
                             unsigned Most) {
  Contributors Found{std::vector<int32_t>(L.pixels() * Most, -1),
                     std::vector<float>(L.pixels() * Most, 0),
                     std::vector<int32_t>(L.pixels(), 0)};
  const Walk W(L, O);
  W.eachPixel([&](const std::vector<uint32_t> &Row, uint32_t X, uint32_t Y) {
    const std::size_t Pixel = std::size_t{Y} * L.Size[0] + X;
    int32_t *const Indices = Found.Indices.data() + Pixel * Most;
    float *const Weights = Found.Weights.data() + Pixel * Most;
    W.pixel(Row, X, Y, [&](const Contribution &C) {
      ++Found.Counts[Pixel];
      // Those of smaller weights move on by one.
      unsigned At = Most;
      while (At > 0 && (Indices[At - 1] < 0 || Weights[At - 1] < C.Weight))
        --At;
      if (At == Most)
        return;
      std::copy_backward(Indices + At, Indices + Most - 1, Indices + Most);
      std::copy_backward(Weights + At, Weights + Most - 1, Weights + Most);
      Indices[At] = static_cast<int32_t>(C.Record % L.Stride);
      Weights[At] = C.Weight;
    });
  });
  return Found;
}

std::vector<float> medianDepths(const PixelLists &L, const RenderOptions &O) {
  std::vector<float> Depths(L.pixels(), 0);
  const Walk W(L, O);
  W.eachPixel([&](const std::vector<uint32_t> &Row, uint32_t X, uint32_t Y) {
    float &Depth = Depths[std::size_t{Y} * L.Size[0] + X];
    float InFront = 1;
    W.pixel(Row, X, Y, [&](const Contribution &C) {
      if (InFront > 0.5F)
        Depth = L.Depths[C.Record] * C.Deeper;
      InFront = C.Behind;
    });
  });
  return Depths;
}

} // namespace vorion::splat
