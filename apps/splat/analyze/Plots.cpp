#include "analyze/Plots.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::splat {

std::map<std::string, Chart> chartsOf(const Analysis &A) {
  Chart Pairs{"Gaussian invocations",
              "tile size (pixels)",
              "invocations (thousands)",
              {},
              {},
              true};
  for (const int Size : AnalyzedTiles)
    Pairs.Places.push_back(std::to_string(Size));
  for (std::size_t K = 0; K < AnalyzedSupports.size(); ++K) {
    ChartSeries S{std::string(name(AnalyzedSupports[K])), {}};
    for (const uint64_t Count : A.BySupport[K])
      S.Values.push_back(static_cast<double>(Count) / 1e3);
    Pairs.Series.push_back(std::move(S));
  }

  Chart Occlusion{"Occluded pixels",
                  "part of the tile's list that is done (%)",
                  "occluded pixels (%)",
                  {},
                  {},
                  false};
  Chart Lengths{"Lengths of the tiles' lists",
                "entries (from; to twice as many)",
                "tiles (%)",
                {},
                {},
                true};
  for (int Percent = 0; Percent <= 100; ++Percent)
    Occlusion.Places.push_back(std::to_string(Percent));
  std::size_t Bins = 0;
  for (const ListStatistics &L : A.Lists)
    Bins = std::max(Bins, L.Histogram.size());
  for (std::size_t K = 0; K < Bins; ++K)
    Lengths.Places.push_back(
        std::to_string(K == 0 ? 0 : uint64_t(1) << (K - 1)));
  for (const std::size_t K : {std::size_t(0), std::size_t(2)}) {
    const std::string Name = fmt::format("{0}x{0} pixels", AnalyzedTiles[K]);
    const ListStatistics &L = A.Lists[K];
    ChartSeries Depth{Name, {}}, Length{Name, {}};
    for (const double Share : L.Occluded)
      Depth.Values.push_back(100 * Share);
    for (std::size_t Bin = 0; Bin < Bins; ++Bin)
      Length.Values.push_back(Bin < L.Histogram.size()
                                  ? 100 *
                                        static_cast<double>(L.Histogram[Bin]) /
                                        static_cast<double>(L.Tiles)
                                  : 0);
    Occlusion.Series.push_back(std::move(Depth));
    Lengths.Series.push_back(std::move(Length));
  }
  return {{"invocations", std::move(Pairs)},
          {"occlusion", std::move(Occlusion)},
          {"lists", std::move(Lengths)}};
}

} // namespace vorion::splat
