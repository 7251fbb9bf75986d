/// The backward mode read aloud for tests: one pixel at a time, in fp32.
#pragma once

#include "raster/Backward.h"
#include "raster/RasterTest.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace vorion::raster {

using Sums = std::array<float, 9>;

/// A tile that was rendered, and the loss's gradient by its pixels.
struct Scene {
  std::vector<Gaussian> Gaussians;
  unsigned X, Y, Width, Height;
  /// By row and column of the tile.
  std::vector<Pixel> Rendered, Upstream;
  std::vector<uint32_t> Last;

  std::size_t at(unsigned Column, unsigned Row) const {
    return std::size_t{Row} * Width + Column;
  }
};

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

/// docs/abi.md, "Backward", one pixel at a time.
inline std::vector<GradientSums>
scalar(const Scene &S, const BackwardOptions &O, const BackwardLoop &L = {}) {
  std::vector<float> T, Behind;
  for (std::size_t I = 0; I != S.Last.size(); ++I) {
    T.push_back(S.Rendered[I].T);
    Behind.push_back(S.Upstream[I].T);
  }
  std::vector<GradientSums> Out(S.Gaussians.size());
  for (std::size_t Entry = S.Gaussians.size(); Entry-- != 0;) {
    const Gaussian &G = S.Gaussians[Entry];
    Parts P;
    for (unsigned Row = 0; Row != S.Height; ++Row)
      for (unsigned Column = 0; Column != S.Width; ++Column) {
        const std::size_t I = S.at(Column, Row);
        const float Dx = G.Mean[0] - (static_cast<float>(S.X + Column) + 0.5F);
        const float Dy = G.Mean[1] - (static_cast<float>(S.Y + Row) + 0.5F);
        if (S.Last[I] <= Entry || !(std::fabs(Dx) <= G.Extent[0]) ||
            !(std::fabs(Dy) <= G.Extent[1]))
          continue;
        const float Power =
            -0.5F * (G.Conic[0] * Dx * Dx + G.Conic[2] * Dy * Dy) -
            G.Conic[1] * Dx * Dy;
        if (!(Power <= 0.0F))
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
        const float Vx = V * -Dx, Vy = V * -Dy;
        Sums &To = P.Rows[Row][Column % 16];
        To = plus(To, {Weight * U.R, Weight * U.G, Weight * U.B, V, Vx, Vy,
                       Vx * -Dx, Vx * -Dy, Vy * -Dy});
      }
    Out[Entry] = {G.Tag, gather(P, O.InRows)};
  }
  return Out;
}

inline std::vector<GradientSums> onLevel(const BackwardDatapath &Level,
                                         const Scene &S, BackwardOptions O) {
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
    Level.Back[0](S.Gaussians[O.Entry], O, *Tile, Out[O.Entry]);
  return Out;
}

} // namespace vorion::raster
