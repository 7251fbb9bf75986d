#include "timing/DatapathUnits.h"

#include "raster/ExpUnits.h"

#include <array>
#include <vector>

namespace vorion::isasim {

namespace {

/// The paper's "streamlined three-stage pipeline", a cycle a stage but for the
/// exponential, which raster/ExpUnits.cpp describes. Operations are those of
/// docs/abi.md, "Rasterizer".
constexpr DatapathUnit Power{
    .Name = "power",
    .Latency = 1,
    .Interval = 1,
    .Multipliers = 7,
    .Adders = 4,
    .TableBits = 0,
    .Source = "first stage [paper]; a dx dx, c dy dy, b dx dy and the half are "
              "7 multiplications, dx, dy and two sums 4 additions"};
constexpr DatapathUnit Alpha{
    .Name = "alpha",
    .Latency = 0,
    .Interval = 1,
    .Multipliers = 1,
    .Adders = 2,
    .TableBits = 0,
    .Source = "second stage [paper], with the exponential: opacity times it, "
              "two comparisons"};
constexpr DatapathUnit Blend{
    .Name = "blend",
    .Latency = 1,
    .Interval = 1,
    .Multipliers = 5,
    .Adders = 5,
    .TableBits = 0,
    .Source =
        "third stage [paper]; T (1 - alpha), alpha T and three colours "
        "are 5 multiplications and 4 additions, the cut-off a comparison"};
constexpr DatapathUnit Gather{.Name = "gather",
                              .Latency = 1,
                              .Interval = 1,
                              .Multipliers = 0,
                              .Adders = 0,
                              .TableBits = 0,
                              .Source =
                                  "writes back to the pixel buffer [paper]"};

using Lane = std::array<DatapathUnit, 5>;

Lane makeLane(const raster::ExpUnit &E) {
  return {Power,
          {.Name = E.Name,
           .Latency = E.LatencyCycles,
           .Interval = 1,
           .Multipliers = 0, // of other widths: E.Multipliers says which
           .Adders = 0,
           .TableBits = E.TableBits,
           .Source = E.Multipliers},
          Alpha,
          Blend,
          Gather};
}

} // namespace

std::span<const DatapathUnit> datapathUnits(unsigned ExpUnit) {
  static const std::vector<Lane> Lanes = [] {
    std::vector<Lane> All;
    for (const raster::ExpUnit &E : raster::expUnits())
      All.push_back(makeLane(E));
    return All;
  }();
  return Lanes[ExpUnit < Lanes.size() ? ExpUnit : 0];
}

unsigned laneDepth(unsigned ExpUnit) {
  unsigned Depth = 0;
  for (const DatapathUnit &U : datapathUnits(ExpUnit))
    Depth += U.Latency;
  return Depth;
}

} // namespace vorion::isasim
