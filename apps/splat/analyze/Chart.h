/// Charts as SVG: axes, lines, bars, a legend; black on white, for print.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vorion::splat {

struct ChartSeries {
  std::string Name;
  std::vector<double> Values; ///< one for each of the chart's places, finite
};

struct Chart {
  std::string Title, XLabel, YLabel;
  std::vector<std::string> Places; ///< along x, evenly spaced
  /// Only every so many places get a label.
  std::size_t LabelEvery = 1;
  std::vector<ChartSeries> Series;
  bool Bars = false; ///< side by side, else lines
};

/// A document of 640 x 420 units. The y axis starts at 0 and ends at a round
/// number that is not below any value.
std::string svgOf(const Chart &C);

} // namespace vorion::splat
