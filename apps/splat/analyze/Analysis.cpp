#include "analyze/Analysis.h"

#include "reference/BlendCounts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace vorion::splat {
namespace {

using reference::Picture;
using reference::TileGrid;
using reference::TileLists;
using Splats = std::vector<reference::Splat<float>>;

Invocations invocationsOf(const Splats &S, reference::Support Reach, int Width,
                          int Height) {
  Invocations Sum{};
  for (std::size_t K = 0; K < AnalyzedTiles.size(); ++K) {
    const TileGrid Grid(AnalyzedTiles[K], Width, Height);
    for (const auto &Splat : S)
      if (Splat.Visible) {
        const auto R = reference::tilesOf(Splat, Reach, Grid);
        Sum[K] += static_cast<uint64_t>(std::max(R.X1 - R.X0, 0)) *
                  static_cast<uint64_t>(std::max(R.Y1 - R.Y0, 0));
      }
  }
  return Sum;
}

/// Of those of \p Values that are not 0.
Distribution distributionOf(std::vector<uint32_t> Values) {
  std::erase(Values, 0U);
  Distribution D;
  D.Count = Values.size();
  if (Values.empty())
    return D;
  std::ranges::sort(Values);
  uint64_t Sum = 0;
  for (const uint32_t V : Values)
    Sum += V;
  D.Mean = static_cast<double>(Sum) / static_cast<double>(D.Count);
  for (std::size_t Percent = 0; Percent < D.Percentiles.size(); ++Percent)
    D.Percentiles[Percent] = Values[Percent * (Values.size() - 1) / 100];
  return D;
}

/// A bin's middle stands for what is in it.
Distribution alphasOf(const reference::BlendCounts &Counts) {
  Distribution D;
  for (const uint64_t Count : Counts.ByAlpha)
    D.Count += Count;
  if (D.Count == 0)
    return D;
  D.Mean = Counts.AlphaSum / static_cast<double>(D.Count);
  uint64_t Below = 0;
  std::size_t Bin = Counts.ByAlpha.size();
  for (std::size_t Percent = 0; Percent < D.Percentiles.size(); ++Percent) {
    while (Below <= Percent * (D.Count - 1) / 100)
      Below += Counts.ByAlpha[--Bin];
    D.Percentiles[Percent] =
        std::pow(255.0, -(static_cast<double>(Bin) + 0.5) /
                            static_cast<double>(Counts.ByAlpha.size()));
  }
  return D;
}

/// Every Gaussian's place from front to back.
std::vector<uint32_t> ranksOf(const Splats &S) {
  std::vector<uint32_t> Ranks(S.size());
  uint32_t Next = 0;
  for (const uint32_t I : reference::depthOrder(S))
    Ranks[I] = Next++;
  return Ranks;
}

ListStatistics statisticsOf(const TileLists &T, const Picture<float> &P,
                            const std::vector<uint32_t> &Ranks) {
  ListStatistics S;
  S.Tiles = T.Lists.size();
  std::vector<uint32_t> Lengths;
  for (const auto &List : T.Lists) {
    Lengths.push_back(static_cast<uint32_t>(List.size()));
    S.Empty += List.empty();
    S.Longest = std::max<uint64_t>(S.Longest, List.size());
    const auto Bin = static_cast<std::size_t>(std::bit_width(List.size()));
    if (S.Histogram.size() <= Bin)
      S.Histogram.resize(Bin + 1);
    ++S.Histogram[Bin];
  }
  S.Mean = static_cast<double>(T.pairs()) / static_cast<double>(S.Tiles);
  S.Filled = distributionOf(std::move(Lengths));

  std::array<uint64_t, 101> FullAt{};
  for (int Y = 0; Y < P.Height; ++Y)
    for (int X = 0; X < P.Width; ++X) {
      const auto At =
          static_cast<std::size_t>(Y) * static_cast<std::size_t>(P.Width) +
          static_cast<std::size_t>(X);
      if (P.Stop[At] < 0)
        continue;
      const auto &List =
          T.Lists[T.Grid.index(X / T.Grid.Size, Y / T.Grid.Size)];
      const uint32_t Rank = Ranks[static_cast<std::size_t>(P.Stop[At])];
      const auto Stop = std::lower_bound(
          List.begin(), List.end(), Rank,
          [&](uint32_t I, uint32_t R) { return Ranks[I] < R; });
      // A Gaussian that rounding alone kept out of the list ends the pixel at
      // the entry behind it.
      const auto Done = std::min(
          static_cast<std::size_t>(Stop - List.begin()) + 1, List.size());
      ++FullAt[(100 * Done + List.size() - 1) / List.size()];
    }
  uint64_t Full = 0;
  for (std::size_t Percent = 0; Percent < FullAt.size(); ++Percent) {
    Full += FullAt[Percent];
    S.Occluded[Percent] =
        static_cast<double>(Full) / static_cast<double>(P.Stop.size());
  }
  return S;
}

} // namespace

double reduction(const Invocations &I, std::size_t From, std::size_t To) {
  return I[From] == 0
             ? 0
             : 1 - static_cast<double>(I[To]) / static_cast<double>(I[From]);
}

Analysis analyze(const reference::Gaussians<float> &G,
                 const reference::Camera<float> &C,
                 const reference::Options &Options) {
  Analysis A;
  for (std::size_t K = 0; K < AnalyzedSupports.size(); ++K) {
    reference::Options O = Options;
    O.Reach = AnalyzedSupports[K];
    const bool Chosen = O.Reach == Options.Reach;
    O.TileSize = AnalyzedTiles[0];
    const Splats S = reference::project(G, C, O);
    A.BySupport[K] = invocationsOf(S, O.Reach, C.Width, C.Height);
    if (!Chosen)
      continue;
    const TileGrid Grid(AnalyzedTiles[0], C.Width, C.Height);
    A.Visible = static_cast<uint64_t>(
        std::count_if(S.begin(), S.end(), [&](const auto &Splat) {
          if (!Splat.Visible)
            return false;
          const auto R = reference::tilesOf(Splat, O.Reach, Grid);
          return R.X0 < R.X1 && R.Y0 < R.Y1;
        }));
    const Picture<float> P = reference::blend(S, C.Width, C.Height, O);
    A.Pixels = P.Stop.size();
    A.Saturated = P.Saturated;
    A.Blends = P.Blends;
    for (std::size_t I = 0; I < P.Stop.size(); ++I) {
      A.Covered += P.Last[I] >= 0;
      A.MeanTransmittance += P.Transmittance[I];
    }
    A.MeanTransmittance /= static_cast<double>(A.Pixels);
    const auto Counts = reference::countBlends(S, C.Width, C.Height, O);
    A.BlendsEach = distributionOf(Counts.Blends);
    A.WalkedEach = distributionOf(Counts.Walked);
    A.Alpha = alphasOf(Counts);
    const auto Ranks = ranksOf(S);
    for (std::size_t T = 0; T < AnalyzedTiles.size(); ++T)
      A.Lists[T] = statisticsOf(
          reference::tileLists(S, O.Reach, AnalyzedTiles[T], C.Width, C.Height),
          P, Ranks);
  }
  return A;
}

} // namespace vorion::splat
