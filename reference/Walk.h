/// Internal to the reference: traversal of a tile's list by a pixel, shared by
/// blending and its backward pass.
#pragma once

#include "Render.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace vorion::reference {

/// Bounds of the support's border under rounding: everything inside \c Inner is
/// certainly in the support, everything outside \c Outer is certainly not.
struct Border {
  double InnerX0, InnerX1, InnerY0, InnerY1;
  double OuterX0, OuterX1, OuterY0, OuterY1;

  bool doubtful(double X, double Y) const {
    const bool Inside =
        InnerX0 <= X && X <= InnerX1 && InnerY0 <= Y && Y <= InnerY1;
    const bool Outside =
        X < OuterX0 || OuterX1 < X || Y < OuterY0 || OuterY1 < Y;
    return !Inside && !Outside;
  }
};

/// A splat as read by the pixels of a tile.
template <typename Real> struct Candidate {
  glm::vec<2, Real> Mean, Extent;
  glm::vec<3, Real> Conic, Color;
  Real Opacity;
  uint32_t Key;                     ///< that orders it
  uint32_t NearestKey, FarthestKey; ///< that z may be rounded to
  Rect Official;                    ///< pixels, for Official16
  Border Edge;                      ///< for supports with a border
  int32_t Index;
  bool Listed; ///< in the tile's list, and not only doubtfully so
};

/// Checks the sort keys of the Gaussians of a pixel, front to back, for
/// ambiguous order.
class DepthOrder {
public:
  /// Processes the next Gaussian; true if it may belong before an earlier one.
  /// Equal keys are in the order of the indices on every machine.
  bool doubtful(uint32_t NearestKey, uint32_t FarthestKey, int32_t Index) {
    const bool Doubtful = std::pair(NearestKey, Index) < Farthest;
    Farthest = std::max(Farthest, std::pair(FarthestKey, Index));
    return Doubtful;
  }

private:
  /// Largest key that an earlier Gaussian may have.
  std::pair<uint32_t, int32_t> Farthest{0, -1};
};

inline bool near(double Value, double Threshold) {
  return std::abs(Value - Threshold) <= DoubtBand * Threshold;
}

/// For the exact support the border is where alpha is 1/255, which \c near
/// checks; \c Outer then only determines the tiles.
template <typename Real>
Border borderOf(const Splat<Real> &S, const Options &O, int Width, int Height) {
  const Support Reach = O.Reach;
  const double Mx = S.Mean.x, My = S.Mean.y;
  if (Reach == Support::Box3 || Reach == Support::Exact) {
    const double In = 1 - DoubtBand, Out = 1 + DoubtBand;
    double Ex = S.Extent.x, Ey = S.Extent.y;
    if (Reach == Support::Exact) {
      const auto Least = leastAlpha<double>(O.AlphaCutoff);
      const double E = std::sqrt(
          2 * std::log(Out * std::max(double(S.Opacity), Least) / Least));
      Ex = E * std::sqrt(double(S.Covariance[0]));
      Ey = E * std::sqrt(double(S.Covariance[2]));
    }
    return {Mx - Ex * In,  Mx + Ex * In,  My - Ey * In,  My + Ey * In,
            Mx - Ex * Out, Mx + Ex * Out, My - Ey * Out, My + Ey * Out};
  }
  // The radius itself is a decision because it is rounded up.
  const double Least = std::ceil(S.CircleRadius * (1 - DoubtBand));
  const double Most = std::ceil(S.CircleRadius * (1 + DoubtBand));
  if (Reach == Support::Square3) {
    const double In = Least * (1 - DoubtBand), Out = Most * (1 + DoubtBand);
    return {Mx - In,  Mx + In,  My - In,  My + In,
            Mx - Out, Mx + Out, My - Out, My + Out};
  }
  // The tile decision takes mean -+ radius, whose rounding in fp32 is relative
  // to the larger of the two.
  const auto Slack = [](double M, double R) {
    return DoubtBand * std::max(std::abs(M), R);
  };
  const auto Pixels = [&](double R, double Sign) {
    const double R0 = R + Sign * std::max(Slack(Mx, R), Slack(My, R));
    return officialPixels(glm::dvec2(S.Mean), R0, Width, Height);
  };
  const Rect In = Pixels(Least, -1), Out = Pixels(Most, 1);
  return {double(In.X0),  double(In.X1),  double(In.Y0),  double(In.Y1),
          double(Out.X0), double(Out.X1), double(Out.Y0), double(Out.Y1)};
}

/// All tiles that contain a pixel of the outer bound of \p B.
inline Rect outerTiles(const Border &B, const TileGrid &Grid) {
  const auto At = [&](double Value, int Count) {
    return static_cast<int>(
        std::clamp(std::floor(Value / Grid.Size), -1.0, double(Count)));
  };
  return {std::max(At(B.OuterX0, Grid.Columns), 0),
          std::max(At(B.OuterY0, Grid.Rows), 0),
          std::min(At(B.OuterX1, Grid.Columns) + 1, Grid.Columns),
          std::min(At(B.OuterY1, Grid.Rows) + 1, Grid.Rows)};
}

/// Whether a pixel whose transmittance would become \p T is saturated.
template <typename Real> bool isFull(Real T, const Options &O) {
  const auto Cutoff = static_cast<Real>(O.Cutoff);
  return O.Rule == Rules::Inria ? T < Cutoff : T <= Cutoff;
}

/// A Gaussian of a pixel, with its depth along the pixel's ray.
struct Seen {
  double Depth;
  int32_t Index;
  double Alpha;
  /// Whether it is densest so near the ray's origin, or where depths are along
  /// rays the near plane, that fp32 may see that on the other side.
  bool IsAtOrigin = false;
  bool operator<(const Seen &Other) const {
    return std::pair(Depth, Index) < std::pair(Other.Depth, Other.Index);
  }
};

/// The contribution of a Gaussian to a pixel.
template <typename Real> struct Contribution {
  std::size_t Entry;  ///< of the tile's list
  Real Dx, Dy;        ///< from the pixel's centre to the mean
  Real Wanted, Alpha; ///< opacity times falloff, before the clamp and after it
  Real T;             ///< transmittance in front of it
};

/// The keys from which on a surface hides Gaussians; and those that a machine
/// may round it to.
struct HidingKeys {
  uint32_t From = ~0U, Nearest = ~0U, Farthest = ~0U;
};

/// Of the surface in pixel \p At.
template <typename Real>
HidingKeys hidingKeys(const Surface<Real> &S, std::size_t At, int DepthBits) {
  const double Depth = S.Depths[At], Slack = S.Slack.empty() ? 0 : S.Slack[At];
  if (!std::isfinite(Depth))
    return {};
  return {orderKey(Depth, DepthBits), orderKey(Depth - Slack, DepthBits),
          orderKey(Depth + Slack, DepthBits)};
}

/// The transparent surfaces in pixel \p At.
template <typename Real>
std::span<const Layer<Real>> layersIn(const Surface<Real> &S, std::size_t At) {
  return S.Layers.empty() ? std::span<const Layer<Real>>() : S.Layers[At];
}

/// The final state of a pixel.
template <typename Real> struct PixelEnd {
  Real T = 1;
  uint8_t Doubts = 0;
  int32_t Last = -1, Stop = -1; ///< as in \c Picture
  uint64_t Walked = 0;          ///< list entries looked at
};

/// Pixels without layers.
struct NoLayers {
  template <typename Real> void operator()(const Layer<Real> &, Real) const {}
};

/// The lists of a picture's tiles, and their traversal by pixels.
template <typename Real> class TileWalk {
public:
  TileWalk(const std::vector<Splat<Real>> &Splats, int Width, int Height,
           const Options &Settings)
      : Splats(Splats), Settings(Settings), Width(Width), Height(Height),
        Grid(Settings.TileSize, Width, Height),
        Least(leastAlpha<Real>(Settings.AlphaCutoff)), Lists(Grid.count()) {
    // As tileLists, but including all entries whose membership is doubtful.
    for (const uint32_t I : depthOrder(Splats, Settings.DepthBits)) {
      const Rect R =
          outerTiles(borderOf(Splats[I], Settings, Width, Height), Grid);
      for (int Y = R.Y0; Y < R.Y1; ++Y)
        for (int X = R.X0; X < R.X1; ++X)
          Lists[Grid.index(X, Y)].push_back(I);
    }
  }

  std::size_t tiles() const { return Lists.size(); }

  /// The pixels of \p Tile inside the picture.
  Rect pixels(std::size_t Tile) const {
    const int X0 = static_cast<int>(Tile) % Grid.Columns * Grid.Size;
    const int Y0 = static_cast<int>(Tile) / Grid.Columns * Grid.Size;
    return {X0, Y0, std::min(X0 + Grid.Size, Width),
            std::min(Y0 + Grid.Size, Height)};
  }

  std::vector<Candidate<Real>> candidates(std::size_t Tile) const {
    std::vector<Candidate<Real>> List;
    List.reserve(Lists[Tile].size());
    for (const uint32_t I : Lists[Tile])
      List.push_back(candidate(I, static_cast<int>(Tile) % Grid.Columns,
                               static_cast<int>(Tile) / Grid.Columns));
    return List;
  }

  /// Traverses the list of pixel (\p X, \p Y) front to back and calls \p Blend
  /// with every \c Contribution. A Gaussian whose key is that of \p Hidden or
  /// more is hidden by a surface. \p Layers are in front of that, and \p
  /// BlendLayer gets each with the transmittance in front of it.
  template <typename Function, typename LayerFunction = NoLayers>
  PixelEnd<Real> pixel(const std::vector<Candidate<Real>> &List, int X, int Y,
                       Function Blend, const HidingKeys &Hidden = {},
                       std::span<const Layer<Real>> Layers = {},
                       LayerFunction BlendLayer = {}) const {
    const Real Px = Real(X) + Real(0.5), Py = Real(Y) + Real(0.5);
    PixelEnd<Real> P;
    DepthOrder Order;
    const auto KeyOf = [&](const Layer<Real> &L) {
      return orderKey(L.Depth, Settings.DepthBits);
    };
    auto NextLayer = Layers.begin();
    const auto BlendLayersUpTo = [&](uint32_t Key) {
      for (; NextLayer != Layers.end() && KeyOf(*NextLayer) <= Key;
           ++NextLayer) {
        BlendLayer(*NextLayer, P.T);
        P.T *= 1 - NextLayer->Alpha;
      }
    };
    for (const Candidate<Real> &C : List) {
      const bool IsHidden = C.Key >= Hidden.From;
      if (IsHidden && C.NearestKey >= Hidden.Farthest)
        break;
      BlendLayersUpTo(C.Key);
      P.Walked += C.Listed && !IsHidden;
      const Real Dx = C.Mean.x - Px, Dy = C.Mean.y - Py;
      const bool Inside = inSupport(C, Dx, Dy, X, Y);
      const bool EdgeInDoubt =
          Settings.Reach != Support::Exact && C.Edge.doubtful(Px, Py);
      if (!Inside && !EdgeInDoubt)
        continue;
      const Real Power =
          Real(-0.5) * (C.Conic[0] * Dx * Dx + C.Conic[2] * Dy * Dy) -
          C.Conic[1] * Dx * Dy;
      if (!(Power <= 0))
        continue;
      // Computed in double: correctly rounded to fp32 except for rare ties.
      const Real Wanted =
          C.Opacity * static_cast<Real>(std::exp(double(Power)));
      const Real Alpha = std::min(mostAlpha<Real>(), Wanted);
      if (near(Alpha, leastAlpha<double>(Settings.AlphaCutoff)) ||
          (EdgeInDoubt && Alpha >= Least))
        P.Doubts |= DoubtThreshold;
      if (!Inside || Alpha < Least)
        continue;
      if ((C.NearestKey < Hidden.Farthest && C.FarthestKey >= Hidden.Nearest) ||
          std::ranges::any_of(Layers, [&](const Layer<Real> &L) {
            return C.NearestKey <
                       orderKey(L.Depth + L.Slack, Settings.DepthBits) &&
                   C.FarthestKey >=
                       orderKey(L.Depth - L.Slack, Settings.DepthBits);
          }))
        P.Doubts |= DoubtOrder;
      if (IsHidden)
        continue;
      if (Order.doubtful(C.NearestKey, C.FarthestKey, C.Index))
        P.Doubts |= DoubtOrder;
      const Real Next = P.T * (1 - Alpha);
      if (near(Next, Settings.Cutoff))
        P.Doubts |= DoubtThreshold;
      if (isFull(Next, Settings)) {
        P.Stop = C.Index;
        break;
      }
      Blend(Contribution<Real>{static_cast<std::size_t>(&C - List.data()), Dx,
                               Dy, Wanted, Alpha, P.T});
      P.T = Next;
      P.Last = C.Index;
    }
    BlendLayersUpTo(~0U);
    return P;
  }

private:
  Candidate<Real> candidate(uint32_t I, int Column, int Row) const {
    const Splat<Real> &S = Splats[I];
    Candidate<Real> C;
    C.Mean = S.Mean;
    C.Extent = S.Extent;
    C.Conic = S.Conic;
    C.Color = S.Color;
    C.Opacity = S.Opacity;
    C.Key = orderKey(double(S.Depth), Settings.DepthBits);
    C.NearestKey = orderKey(double(S.Depth) - S.DepthSlack, Settings.DepthBits);
    C.FarthestKey =
        orderKey(double(S.Depth) + S.DepthSlack, Settings.DepthBits);
    C.Official = officialPixels(S.Mean, S.Extent.x, Width, Height);
    C.Edge = borderOf(S, Settings, Width, Height);
    C.Index = static_cast<int32_t>(I);
    C.Listed = tilesOf(S, Settings.Reach, Grid).contains(Column, Row);
    return C;
  }

  bool inSupport(const Candidate<Real> &C, Real Dx, Real Dy, int X,
                 int Y) const {
    if (Settings.Reach == Support::Exact)
      return true;
    if (Settings.Reach == Support::Official16)
      return C.Official.contains(X, Y);
    return std::abs(Dx) <= C.Extent.x && std::abs(Dy) <= C.Extent.y;
  }

  const std::vector<Splat<Real>> &Splats;
  const Options &Settings;
  int Width, Height;
  TileGrid Grid;
  Real Least;
  std::vector<std::vector<uint32_t>> Lists;
};

/// Calls \p Work with every tile from 0 to \p Tiles - 1 on \p Threads threads,
/// 0 for one per processor. The calls must be independent of their order.
template <typename Function>
void forEachTile(std::size_t Tiles, unsigned Threads, Function Work) {
  std::atomic<std::size_t> Next = 0;
  const auto Share = [&] {
    for (std::size_t T = Next++; T < Tiles; T = Next++)
      Work(T);
  };
  if (Threads == 0)
    Threads = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::thread> Others;
  for (unsigned I = 1; I < Threads; ++I)
    Others.emplace_back(Share);
  Share();
  for (std::thread &Other : Others)
    Other.join();
}

} // namespace vorion::reference
