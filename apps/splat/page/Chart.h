/// What a chart of a page shows.
#pragma once

#include <string>
#include <vector>

namespace vorion::splat {

struct ChartSeries {
  std::string Name;
  std::vector<double> Values; ///< one for each place, finite
};

struct Chart {
  std::string Title, XLabel, YLabel;
  std::vector<std::string> Places; ///< along x, evenly spaced
  std::vector<ChartSeries> Series;
  bool Bars = false; ///< side by side, else lines
};

} // namespace vorion::splat
