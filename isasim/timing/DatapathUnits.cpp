#include "timing/DatapathUnits.h"

#include "raster/BlendUnits.h"
#include "raster/ExpUnits.h"
#include "raster/Reciprocals.h"
#include "vorion/support/Json.h"

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

namespace vorion::isasim {

namespace {

using Lane = std::array<DatapathUnit, 5>;

/// The paper's "streamlined three-stage pipeline", a cycle a stage but for the
/// exponential. Operations are those of docs/abi.md, "Rasterizer".
constexpr DatapathUnit PowerUnit{
    .Name = "power",
    .Latency = 1,
    .Interval = 1,
    .Multipliers = 7,
    .Adders = 4,
    .ProductBits = 0,
    .AdderBits = 0,
    .TableBits = 0,
    .Source = "first stage [paper]; a dx dx, c dy dy, b dx dy and the half are "
              "7 multiplications, dx, dy and two sums 4 additions"};
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

/// The paper names no exponential: latencies and operations are our estimates
/// of a plausible build. The ones after the first take y = -p log2(e) first.
constexpr DatapathUnit ExpOf[raster::ExpUnitCount] = {
    {"correctly-rounded", 8, 1, 0, 0, 16 * 53 * 53, 14 * 53, 0,
     "16 multipliers of 53 x 53 bits, 14 adders of 53: as the simulator finds "
     "the nearest number"},
    {"table", 3, 1, 0, 0, 24 * 24 + 12 * 12, 17 + 8, 16 * (17 + 12),
     "y 24 x 24 bits, a rest times a drop 12 x 12; a sum of 17, an exponent"},
    {"poly2", 4, 1, 3, 3, 0, 8, 0,
     "y, then two steps of Horner's rule, in fp32; y's fraction; an exponent"},
    {"poly3", 5, 1, 4, 4, 0, 8, 0,
     "y, then three steps of Horner's rule, in fp32; y's fraction; an "
     "exponent"},
    {"poly4", 6, 1, 5, 5, 0, 8, 0,
     "y, then four steps of Horner's rule, in fp32; y's fraction; an exponent"},
    {"table32", 3, 1, 0, 0, 24 * 24 + 12 * 12, 18 + 8, 32 * (18 + 12),
     "as table, with a sum of 18"},
    {"table64", 3, 1, 0, 0, 24 * 24 + 12 * 12, 19 + 8, 64 * (19 + 12),
     "as table, with a sum of 19"},
    {"linear", 2, 1, 0, 0, 24 * 24, 2 * 17 + 8, 0,
     "y 24 x 24 bits; a drop of two shifted rests, two sums of 17; an "
     "exponent"},
    {"schraudolph", 1, 1, 0, 0, 24 * 24, 32, 0,
     "p log2(e) 24 x 24 bits, a sum of 32"},
};

constexpr std::string_view NarrowSource =
    "alpha T and three colours are 4 multiplications whose products are exact, "
    "so without rounding or normalisation: a significand product and an "
    "exponent sum of 8 each; 4 fp32 sums, the cut-off a comparison; 3 operands "
    "rounded by sums of 16";
constexpr DatapathUnit BlendOf[raster::BlendUnitCount] = {
    {"blend", 1, 1, 5, 5, 0, 0, 0,
     "third stage [paper]; T (1 - alpha), alpha T and three colours are 5 "
     "multiplications and 4 additions, the cut-off a comparison"},
    {"blend bf16", 1, 1, 0, 5, 4 * 8 * 8, 4 * 8 + 3 * 16, 0, NarrowSource},
    {"blend fp16", 1, 1, 0, 5, 4 * 11 * 11, 4 * 8 + 3 * 16, 0, NarrowSource},
};

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

const Lane &laneOf(raster::LaneUnits Units) {
  static const Lanes All = [] {
    Lanes Made;
    for (std::size_t E = 0; E != Made.size(); ++E)
      for (std::size_t B = 0; B != Made[E].size(); ++B)
        Made[E][B] = {PowerUnit, ExpOf[E], AlphaUnit, BlendOf[B], GatherUnit};
    return Made;
  }();
  return All[Units.Exp < All.size() ? Units.Exp : 0]
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

using BackwardPair = std::array<DatapathUnit, 3>;

/// An fp32 multiplier and a divider differ in what is between exponents and
/// rounding: there a product of 24 x 24 bits, here a row of 24 bits for each
/// bit of the quotient, with a choice between remainder and difference (the bit
/// above a row's needs no subtraction: if it is set, the row's succeeds).
DatapathUnit divider(const raster::ReciprocalUnit &R) {
  constexpr unsigned Significand = 24, Exponent = 8, Rows = 26;
  // Between stages: remainder, divisor, exponent, half the quotient on average.
  constexpr unsigned Alive = 2 * Significand + Exponent + Rows / 2;
  return {.Name = R.Name,
          .Latency = R.LatencyCycles,
          .Interval = 1,
          .Multipliers = R.Multipliers,
          .Adders = 0,
          .ProductBits = -static_cast<int>(Significand * Significand),
          .AdderBits = Rows * Significand,
          .TableBits = 0,
          .Source = R.Cost,
          .ChoiceBits = Rows * Significand,
          .RegisterBits = (R.LatencyCycles - 1) * Alive};
}

/// From a table's entry, or by the Taylor series.
DatapathUnit iterated(const raster::ReciprocalUnit &R) {
  // Between stages: 1 - alpha, or alpha, and what is made of it so far.
  constexpr unsigned Alive = 2 * 32;
  return {.Name = R.Name,
          .Latency = R.LatencyCycles,
          .Interval = 1,
          .Multipliers = R.Multipliers,
          .Adders = 3,
          .ProductBits = 0,
          .AdderBits = 0,
          .TableBits = R.TableBits,
          .Source = R.Cost,
          .RegisterBits = (R.LatencyCycles - 1) * Alive};
}

BackwardPair makePair(const raster::ReciprocalUnit &R) {
  const bool Exact =
      R.Option == static_cast<std::uint32_t>(raster::Reciprocal::Exact);
  return {Exact ? divider(R) : iterated(R), GradientUnit, SumUnit};
}

} // namespace

std::span<const DatapathUnit> datapathUnits(raster::LaneUnits Units) {
  return laneOf(Units);
}

std::span<const DatapathUnit> backwardUnits(unsigned Reciprocal) {
  static const std::vector<BackwardPair> Pairs = [] {
    std::vector<BackwardPair> All;
    for (const raster::ReciprocalUnit &R : raster::reciprocalUnits())
      All.push_back(makePair(R));
    return All;
  }();
  return Pairs[Reciprocal < Pairs.size() ? Reciprocal : 0];
}

unsigned backwardDepth(raster::LaneUnits Units, unsigned Reciprocal) {
  unsigned Depth = laneDepth(Units);
  for (const DatapathUnit &U : backwardUnits(Reciprocal))
    Depth += U.Latency;
  return Depth;
}

unsigned laneDepth(raster::LaneUnits Units) {
  unsigned Depth = 0;
  for (const DatapathUnit &U : laneOf(Units))
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
  return PaperLane - unitsArea({.Exp = raster::VR_EXP_TABLE,
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
  for (const DatapathUnit &U : ExpOf)
    J["exp"].push_back(area(U));
  for (const DatapathUnit &U : BlendOf)
    J["blend"].push_back(area(U));
  for (const raster::ReciprocalUnit &R : raster::reciprocalUnits())
    J["reciprocal"].push_back(area(backwardUnits(R.Option).front()));
  J["other"] =
      restOfLane() + area(PowerUnit) + area(AlphaUnit) + area(GatherUnit);
  return jsonText(J);
}

} // namespace vorion::isasim
