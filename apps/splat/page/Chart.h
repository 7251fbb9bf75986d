/// Charts as SVG, in the look of the pages: for documents, and for whatever
/// shows no page.
#pragma once

#include <string>
#include <string_view>
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
  bool Bars = false;             ///< side by side, else lines
  std::vector<std::string> Made; ///< for the foot: what made it
};

/// A document of 760 units' width, light or dark as its reader's settings say.
/// The y axis starts at 0 and ends at a round number that is not below any
/// value.
std::string svgOf(const Chart &C);

/// look.css, whose colours charts have.
std::string_view lookSheet();

} // namespace vorion::splat
