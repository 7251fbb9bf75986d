/// What the units of a rasterizer's lane are and cost, in one place: the clock
/// takes latencies from here, reports the rest.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vorion::isasim {

/// A unit of every lane, unless \c Shared.
struct DatapathUnit {
  std::string_view Name;
  unsigned Latency;             ///< cycles
  unsigned Interval;            ///< cycles between two operations
  unsigned Multipliers, Adders; ///< fp32
  unsigned TableBits;
  std::string_view Source; ///< or derivation
};

/// In the order in which a pixel passes them. The exponential unit is the one
/// that raster::expUnits() has for \p ExpUnit.
std::span<const DatapathUnit> datapathUnits(unsigned ExpUnit);

/// Cycles from giving a pixel to a lane until its new value is stored.
unsigned laneDepth(unsigned ExpUnit);

} // namespace vorion::isasim
