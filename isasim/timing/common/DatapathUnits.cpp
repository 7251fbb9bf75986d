#include "timing/common/DatapathUnits.h"

#include "timing/UnitParts.h"
#include "vorion/support/Json.h"

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

namespace vorion::isasim {

namespace {

using Lane = std::array<DatapathUnit, 5>;

/// With the front end, the paper's "streamlined three-stage pipeline", a cycle
/// a stage but for the exponential. Operations are those of docs/abi.md,
/// "Rasterizer".
constexpr DatapathUnit AlphaUnit{
    .Name = "alpha",
    .Latency = 0,
    .Interval = 1,
    .Multipliers = 1,
    .Adders = 2,
    .ProductBits = 0,
    .AdderBits = 0,
    .TableBits = 0,
    .Source = "second stage [paper], with the exponential: opacity times it, "
              "two comparisons"};
constexpr DatapathUnit GatherUnit{
    .Name = "gather",
    .Latency = 1,
    .Interval = 1,
    .Multipliers = 0,
    .Adders = 0,
    .ProductBits = 0,
    .AdderBits = 0,
    .TableBits = 0,
    .Source = "writes back to the pixel buffer [paper]"};

/// Areas at 45 nm, um^2: W. Dally, "High-performance hardware for machine
/// learning", NIPS tutorial 2015 (32-bit floating and fixed point). Choices and
/// registers are the cells MUX2_X1 and DFF_X1 of the Nangate 45 nm Open Cell
/// Library, whose full adder, FA_X1 with 4.256, is Dally's bit of an adder. A
/// bit of a table in logic is ours.
constexpr double MultiplierArea = 7700, AdderArea = 4184;
constexpr double ProductBitArea = 3495.0 / (32 * 32);
constexpr double AdderBitArea = 137.0 / 32;
constexpr double ChoiceBitArea = 1.862, RegisterBitArea = 4.522;
constexpr double TableBitArea = 1;

using Lanes =
    std::array<std::array<Lane, raster::BlendUnitCount>, raster::ExpUnitCount>;

/// Of opaque primitives.
using SurfaceLane = std::array<DatapathUnit, 2>;

/// By row of FrontEnds; those of kinds that blend are not used.
std::span<const DatapathUnit> surfaceLane(uint8_t FrontEnd) {
  static const std::vector<SurfaceLane> All = [] {
    std::vector<SurfaceLane> Made;
    for (const DatapathUnit &U : FrontEndParts)
      Made.push_back({U, GatherUnit});
    return Made;
  }();
  return All[FrontEnd < All.size() ? FrontEnd : 0];
}

/// By row of FrontEnds; those of opaque kinds are not used.
const Lane &laneOf(raster::LaneUnits Units) {
  static const auto All = [] {
    std::array<Lanes, std::size(FrontEndParts)> Made;
    for (std::size_t F = 0; F != Made.size(); ++F)
      for (std::size_t E = 0; E != Made[F].size(); ++E)
        for (std::size_t B = 0; B != Made[F][E].size(); ++B)
          Made[F][E][B] = {FrontEndParts[F], ExpParts[E], AlphaUnit,
                           BlendParts[B], GatherUnit};
    return Made;
  }();
  return All[Units.FrontEnd < All.size() ? Units.FrontEnd : 0]
            [Units.Exp < raster::ExpUnitCount ? Units.Exp : 0]
            [Units.Blend < raster::BlendUnitCount ? Units.Blend : 0];
}

/// Beyond two rendering lanes, whose multipliers and adders the gradients use
/// (docs/rasterizer.md, "The backward mode").
constexpr DatapathUnit GradientUnit{
    "gradients",
    2,
    1,
    0,
    0,
    0,
    0,
    0,
    "16 multiplications and 4 additions a pixel, in the 17 multipliers that "
    "alpha leaves of both lanes; ours"};
constexpr DatapathUnit SumUnit{
    "sums",
    4,
    1,
    0,
    9,
    0,
    0,
    0,
    "nine accumulators a pair; across 8 pairs a tree of 3 levels, and one for "
    "the rows; ours"};

/// The same of rays.
constexpr DatapathUnit RayGradientUnit{
    "gradients of rays",
    3,
    1,
    2,
    0,
    0,
    0,
    0,
    "23 multiplications and 4 additions a pixel, in the 21 multipliers that "
    "alpha leaves of both lanes and two more; l / D in the divider of the "
    "other lane; ours"};
constexpr DatapathUnit RaySumUnit{
    "sums of rays",
    4,
    1,
    0,
    12,
    0,
    0,
    0,
    "as the sums, with twelve accumulators; ours"};

using BackwardPair = std::array<DatapathUnit, 3>;

} // namespace

std::span<const DatapathUnit> datapathUnits(raster::LaneUnits Units) {
  return Units.isOpaque() ? surfaceLane(Units.FrontEnd)
                          : std::span<const DatapathUnit>(laneOf(Units));
}

std::string_view expUnitName(uint8_t Exp) { return ExpParts[Exp].Name; }
std::string_view blendUnitName(uint8_t Blend) { return BlendParts[Blend].Name; }

std::span<const DatapathUnit> backwardUnits(unsigned Reciprocal,
                                            raster::LaneUnits Of) {
  const auto With = [](const DatapathUnit &Gradients,
                       const DatapathUnit &Sums) {
    std::vector<BackwardPair> All;
    for (const DatapathUnit &Unit : ReciprocalParts)
      All.push_back({Unit, Gradients, Sums});
    return All;
  };
  static const std::vector<BackwardPair> Conics = With(GradientUnit, SumUnit),
                                         Rays =
                                             With(RayGradientUnit, RaySumUnit);
  const auto &Pairs = Of.isConic() ? Conics : Rays;
  return Pairs[Reciprocal < Pairs.size() ? Reciprocal : 0];
}

unsigned backwardDepth(raster::LaneUnits Units, unsigned Reciprocal) {
  unsigned Depth = laneDepth(Units);
  for (const DatapathUnit &U : backwardUnits(Reciprocal, Units))
    Depth += U.Latency;
  return Depth;
}

unsigned laneDepth(raster::LaneUnits Units) {
  unsigned Depth = 0;
  for (const DatapathUnit &U : datapathUnits(Units))
    Depth += U.Latency;
  return Depth;
}

double area(const DatapathUnit &U) {
  return U.Multipliers * MultiplierArea + U.Adders * AdderArea +
         U.ProductBits * ProductBitArea + U.AdderBits * AdderBitArea +
         U.TableBits * TableBitArea + U.ChoiceBits * ChoiceBitArea +
         U.RegisterBits * RegisterBitArea;
}

namespace {

double unitsArea(raster::LaneUnits Units) {
  double Sum = 0;
  for (const DatapathUnit &U : laneOf(Units))
    Sum += area(U);
  return Sum;
}

/// What belongs to a lane besides its units. Paper, "Gaussian rasterizer
/// architecture": three adders and three multipliers a pair of lanes add 7 % to
/// a lane's area; that lane is taken to have the table unit.
double restOfLane() {
  const double PaperLane = 1.5 * (MultiplierArea + AdderArea) / 0.07;
  return PaperLane - unitsArea({.Exp = raster::expRowOf(raster::VR_EXP_TABLE),
                                .Blend = raster::VR_BLEND_FP32});
}

} // namespace

double laneArea(raster::LaneUnits Units) {
  return restOfLane() + unitsArea(Units);
}

std::string areasJson() {
  nlohmann::ordered_json J{{"exp", nlohmann::json::array()},
                           {"blend", nlohmann::json::array()},
                           {"reciprocal", nlohmann::json::array()}};
  for (uint32_t Row = 0; Row != raster::ExpUnitCount; ++Row) {
    // Reserved numbers have no area.
    while (J["exp"].size() != raster::ExpUnits[Row].Option)
      J["exp"].push_back(0);
    J["exp"].push_back(area(ExpParts[Row]));
  }
  for (const DatapathUnit &U : BlendParts)
    J["blend"].push_back(area(U));
  for (const DatapathUnit &U : ReciprocalParts)
    J["reciprocal"].push_back(area(U));
  J["other"] = restOfLane() + area(FrontEndParts[0]) + area(AlphaUnit) +
               area(GatherUnit);
  return jsonText(J);
}

} // namespace vorion::isasim
