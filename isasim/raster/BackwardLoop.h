/// The backward mode read aloud for tests: one pixel at a time, in fp32.
#pragma once

#include "raster/Backward.h"
#include "raster/RasterTest.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>

namespace vorion::raster {

using Sums = decltype(GradientSums::Sums);

/// A tile that was rendered, and the loss's gradient by its pixels.
template <typename Record> struct SceneOf {
  std::vector<Record> Gaussians;
  unsigned X, Y, Width, Height;
  /// By row and column of the tile.
  std::vector<Pixel> Rendered, Upstream;
  std::vector<uint32_t> Last;

  std::size_t at(unsigned Column, unsigned Row) const {
    return std::size_t{Row} * Width + Column;
  }
};

using Scene = SceneOf<Gaussian>;

/// What a broken loop does otherwise.
struct BackwardLoop {
  bool HoldsT = false; ///< at 1, which rounding may pass
};

/// The parts of one pixel, and where the gather puts them.
struct Parts {
  std::array<std::array<Sums, 16>, VR_MAX_TILE> Rows{}; ///< [row][column % 16]
};

inline Sums plus(const Sums &A, const Sums &B) {
  Sums R{};
  for (unsigned K = 0; K != R.size(); ++K)
    R[K] = A[K] + B[K];
  return R;
}

/// docs/abi.md's gather read aloud.
inline Sums gather(const Parts &P, bool InRows) {
  std::array<Sums, 16> Columns{};
  for (unsigned C = 0; C != 16; ++C) {
    std::vector<Sums> Nodes;
    Nodes.reserve(P.Rows.size());
    for (const auto &Row : P.Rows)
      Nodes.push_back(Row[C]);
    if (InRows) {
      for (const Sums &Row : Nodes)
        Columns[C] = plus(Columns[C], Row);
      continue;
    }
    for (; Nodes.size() != 1; Nodes.resize(Nodes.size() / 2))
      for (std::size_t N = 0; N != Nodes.size() / 2; ++N)
        Nodes[N] = plus(Nodes[2 * N], Nodes[2 * N + 1]);
    Columns[C] = Nodes[0];
  }
  for (unsigned Half = 8; Half != 0; Half /= 2)
    for (unsigned C = 0; C != Half; ++C)
      Columns[C] = plus(Columns[C], Columns[C + Half]);
  return Columns[0];
}

inline float reciprocalOf(Reciprocal Unit, float Alpha) {
  std::array<float, 16> V;
  V.fill(Alpha);
  backwardDatapaths().front()->Reciprocals(Unit, V.data(), V.size());
  return V[0];
}

/// What pixel centre (Px, Py) sees of a Gaussian: a power that is no number
/// outside of its box.
struct OffsetOfConic {
  float Dx, Dy, Power;
  OffsetOfConic(const Gaussian &G, float Px, float Py, RayFalloff)
      : Dx(G.Mean[0] - Px), Dy(G.Mean[1] - Py),
        Power(-0.5F * (G.Conic[0] * Dx * Dx + G.Conic[2] * Dy * Dy) -
              G.Conic[1] * Dx * Dy) {
    if (!(std::fabs(Dx) <= G.Extent[0]) || !(std::fabs(Dy) <= G.Extent[1]))
      Power = NotANumber;
  }
  /// What is summed beside colour and s.
  void moments(float V, Sums &To) const {
    const float Vx = V * -Dx, Vy = V * -Dy;
    To[4] = Vx;
    To[5] = Vy;
    To[6] = Vx * -Dx;
    To[7] = Vx * -Dy;
    To[8] = Vy * -Dy;
  }
};

/// The same of a ray.
struct OffsetOfRay {
  float U, V, Q, Power;
  float Dx, Dy;             ///< from the mean to the pixel
  bool IsOnPicture = false; ///< the low pass decides
  RayFalloff Falloff;
  OffsetOfRay(const RayGaussian &G, float Px, float Py, RayFalloff Falloff)
      : Falloff(Falloff) {
    const float Column = static_cast<float>(G.First & 0xFFFF) + 0.5F;
    const float Row = static_cast<float>(G.First >> 16) + 0.5F;
    Dx = (Px - Column) - G.Mean[0];
    Dy = (Py - Row) - G.Mean[1];
    const float Across = G.Factor[0] * Dx + G.Factor[1] * Dy;
    const float Down = G.Factor[2] * Dy;
    const float Beside = Across * Across + Down * Down;
    const float L = (1.0F + G.Slope[0] * Dx) + G.Slope[1] * Dy;
    const float Far = L * L + G.Near * Beside;
    Q = Beside / Far;
    U = Across * (L / Far);
    V = Down * (L / Far);
    bool IsMet = L > 0.0F;
    if (const float Blurred = 2.0F * (Dx * Dx + Dy * Dy);
        Falloff.IsLowPass && !(IsMet && Q <= Blurred)) {
      IsOnPicture = IsMet = true;
      Q = Blurred;
    }
    Power = Falloff.IsDegree4 ? -1.0F / 18.0F * Q * Q : -0.5F * Q;
    const bool IsInBox = Px >= Column && Py >= Row &&
                         Px <= static_cast<float>(G.Last & 0xFFFF) + 0.5F &&
                         Py <= static_cast<float>(G.Last >> 16) + 0.5F;
    if (!IsMet || !IsInBox)
      Power = NotANumber;
  }
  void moments(float S, Sums &To) const {
    const float T = Falloff.IsDegree4 ? S * Q : S;
    if (IsOnPicture) {
      To[12] = T * Dx;
      To[13] = T * Dy;
      return;
    }
    To[4] = T * U;
    To[5] = T * V;
    To[6] = T * U * U;
    To[7] = T * U * V;
    To[8] = T * V * V;
    To[9] = T * U * Q;
    To[10] = T * V * Q;
    To[11] = T * Q * Q;
  }
};

template <typename Record>
using OffsetOf = std::conditional_t<std::is_same_v<Record, Gaussian>,
                                    OffsetOfConic, OffsetOfRay>;

/// docs/abi.md, "Backward", one pixel at a time.
template <typename Record>
std::vector<GradientSums> scalarLoop(const SceneOf<Record> &S,
                                     const BackwardOptions &O,
                                     const BackwardLoop &L = {}) {
  std::vector<float> T, Behind;
  for (std::size_t I = 0; I != S.Last.size(); ++I) {
    T.push_back(S.Rendered[I].T);
    Behind.push_back(S.Upstream[I].T);
  }
  std::vector<GradientSums> Out(S.Gaussians.size());
  for (std::size_t Entry = S.Gaussians.size(); Entry-- != 0;) {
    const Record &G = S.Gaussians[Entry];
    Parts P;
    for (unsigned Row = 0; Row != S.Height; ++Row)
      for (unsigned Column = 0; Column != S.Width; ++Column) {
        const std::size_t I = S.at(Column, Row);
        const OffsetOf<Record> Offset(
            G, static_cast<float>(S.X + Column) + 0.5F,
            static_cast<float>(S.Y + Row) + 0.5F, O.Falloff);
        const float Power = Offset.Power;
        if (S.Last[I] <= Entry || !(Power <= 0.0F))
          continue;
        const float Wanted =
            G.Opacity *
            static_cast<float>(std::exp(static_cast<double>(Power)));
        const float Alpha = std::fmin(0.99F, Wanted);
        if (Alpha < 1.0F / 255.0F)
          continue;
        const Pixel &U = S.Upstream[I];
        T[I] = O.Unit == Reciprocal::Exact ? T[I] / (1.0F - Alpha)
                                           : T[I] * reciprocalOf(O.Unit, Alpha);
        if (L.HoldsT)
          T[I] = std::fmin(T[I], 1.0F);
        const float Light =
            G.Color[0] * U.R + G.Color[1] * U.G + G.Color[2] * U.B;
        const float Gain = Light - Behind[I];
        Behind[I] = Behind[I] + Alpha * Gain;
        const float Weight = Alpha * T[I];
        const float V =
            O.ClampStops && Wanted > 0.99F ? 0.0F : Wanted * (T[I] * Gain);
        Sums Own{Weight * U.R, Weight * U.G, Weight * U.B, V};
        Offset.moments(V, Own);
        Sums &To = P.Rows[Row][Column % 16];
        To = plus(To, Own);
      }
    Out[Entry] = {G.Tag, gather(P, O.InRows)};
  }
  return Out;
}

template <typename Record>
std::vector<GradientSums> onLevel(const BackwardDatapath &Level,
                                  const SceneOf<Record> &S, BackwardOptions O) {
  const BackFunction<Record> Back = [&] {
    if constexpr (std::is_same_v<Record, Gaussian>)
      return Level.Conics[0];
    else
      return (O.Falloff.IsLowPass ? Level.Surfels : Level.Rays)[0];
  }();
  auto Tile = std::make_unique<BackwardBuffer>();
  Tile->reset(S.X, S.Y, S.Width, S.Height);
  for (unsigned Row = 0; Row != S.Height; ++Row)
    for (unsigned Column = 0; Column != S.Width; ++Column) {
      const unsigned At = Row * BackwardBuffer::Stride + Column;
      const std::size_t I = S.at(Column, Row);
      Tile->R[At] = S.Upstream[I].R;
      Tile->G[At] = S.Upstream[I].G;
      Tile->B[At] = S.Upstream[I].B;
      Tile->Behind[At] = S.Upstream[I].T;
      Tile->T[At] = S.Rendered[I].T;
      Tile->Last[At] = S.Last[I];
      Tile->RowLast[Row] = std::max(Tile->RowLast[Row], S.Last[I]);
    }
  std::vector<GradientSums> Out(S.Gaussians.size());
  for (O.Entry = static_cast<uint32_t>(Out.size()); O.Entry-- != 0;)
    Back(S.Gaussians[O.Entry], O, *Tile, Out[O.Entry]);
  return Out;
}

} // namespace vorion::raster
