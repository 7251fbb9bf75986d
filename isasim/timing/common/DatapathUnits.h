/// What the units of a rasterizer's lane are and cost, in one place: the clock
/// takes latencies from here, reports the rest.
#pragma once

#include "raster/WorkLog.h"

#include <span>
#include <string>
#include <string_view>

namespace vorion::isasim {

/// A unit of every lane.
struct DatapathUnit {
  std::string_view Name;
  unsigned Latency;             ///< cycles
  unsigned Interval;            ///< cycles between two operations
  unsigned Multipliers, Adders; ///< fp32
  /// Of multipliers of other widths, bits times bits; below 0, what an fp32
  /// multiplier above has less than a whole one.
  int ProductBits;
  unsigned AdderBits; ///< of other adders
  unsigned TableBits;
  std::string_view Source; ///< or derivation
  /// Where registers between its stages are counted; a lane's are part of what
  /// it is besides its units.
  unsigned ChoiceBits = 0, RegisterBits = 0;
};

/// In the order in which a pixel passes them; units that do not exist count as
/// the first.
std::span<const DatapathUnit> datapathUnits(raster::LaneUnits Units);

/// \name Names of units, by the members of raster::LaneUnits
/// @{
std::string_view expUnitName(uint8_t Exp);
std::string_view blendUnitName(uint8_t Blend);
/// @}

/// Cycles from giving a pixel to a lane until its new value is stored.
unsigned laneDepth(raster::LaneUnits Units);

/// \name Areas, um^2 at 45 nm (docs/lane-units.md, "Area of a lane")
/// @{
double area(const DatapathUnit &U);
/// Of a lane with its share of the rasterizer's buffers, dispatch and gather.
double laneArea(raster::LaneUnits Units);
/// The parts of that as JSON: "exp" and "blend", areas by option, 0 for one
/// that is reserved, and "other"; and "reciprocal", by option, of a pair of
/// lanes.
std::string areasJson();
/// @}

/// What a pair of lanes has beyond two lanes in the backward mode: the unit
/// that raster::ReciprocalUnits has for \p Reciprocal, and by the front end of
/// \p Of those for gradients and for sums.
std::span<const DatapathUnit> backwardUnits(unsigned Reciprocal,
                                            raster::LaneUnits Of = {});

/// Cycles from giving a pixel to a pair until it is in its Gaussian's sums.
unsigned backwardDepth(raster::LaneUnits Units, unsigned Reciprocal);

} // namespace vorion::isasim
