/// Charts as SVG, in the style of the pages, for documents and standalone
/// files.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::splat {

struct ChartSeries {
  std::string Name;
  std::vector<double> Values; ///< one for each place or number, finite
};

struct Chart {
  std::string Title, XLabel, YLabel;
  std::vector<std::string> Places; ///< along x, evenly spaced
  /// Interval of labelled positions.
  std::size_t LabelEvery = 1;
  std::vector<ChartSeries> Series;
  bool Bars = false;             ///< side by side, else lines
  std::vector<std::string> Made; ///< for the foot: what made it
  /// Where places of a whole quantity lie, rising, in place of their labels:
  /// the axis then goes from 0 to \c NumbersEnd, which is no less than the
  /// last, and has round numbers.
  // May be left out: NOLINTNEXTLINE(readability-redundant-member-init)
  std::vector<double> Numbers = {};
  double NumbersEnd = 0;
};

/// An SVG document of 760 units width, light or dark by the reader's settings.
/// The y axis is from 0 to a round number that is not below any value.
std::string svgOf(const Chart &C);

/// look.css, whose colours charts have.
std::string_view lookSheet();

} // namespace vorion::splat
