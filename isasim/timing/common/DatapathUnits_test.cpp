// Depths and areas of a rasterizer's lane against their definitions.
#include "timing/common/DatapathUnits.h"

#include "raster/UnitTables.h"

#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

using namespace vorion;
using namespace vorion::isasim;

namespace {

template <typename Function> void forAllLanes(Function Use) {
  for (uint8_t Exp = 0; Exp != raster::ExpUnitCount; ++Exp)
    for (uint8_t Blend = 0; Blend != raster::BlendUnitCount; ++Blend)
      Use(raster::LaneUnits{Exp, Blend});
}

TEST(DatapathUnits, ThePapersGradientUnitsAreSevenPercent) {
  // Three fp32 adders and multipliers for two lanes, in the published areas.
  const double Added = 1.5 * (7700 + 4184);
  const raster::LaneUnits Paper{raster::VR_EXP_TABLE, raster::VR_BLEND_FP32};
  EXPECT_NEAR(Added / laneArea(Paper), 0.07, 1e-9);
}

TEST(DatapathUnits, ALaneDiffersByItsUnits) {
  const double Default = laneArea({});
  forAllLanes([&](raster::LaneUnits L) {
    double Change = 0;
    for (size_t N = 0; N != datapathUnits(L).size(); ++N)
      Change += area(datapathUnits(L)[N]) - area(datapathUnits({})[N]);
    EXPECT_NEAR(laneArea(L) - Default, Change, 1e-6);
  });
  // What is coarser is smaller.
  EXPECT_LT(laneArea({raster::VR_EXP_POLY3, 0}), laneArea({}));
  EXPECT_LT(laneArea({raster::VR_EXP_TABLE, 0}),
            laneArea({raster::VR_EXP_TABLE64, 0}));
  EXPECT_LT(laneArea({0, raster::VR_BLEND_BF16}),
            laneArea({0, raster::VR_BLEND_FP16}));
  EXPECT_LT(laneArea({0, raster::VR_BLEND_FP16}), Default);
}

TEST(DatapathUnits, DepthIsTheSumOfLatencies) {
  forAllLanes([](raster::LaneUnits L) {
    unsigned Sum = 0;
    for (const DatapathUnit &U : datapathUnits(L)) {
      Sum += U.Latency;
      EXPECT_EQ(U.Interval, 1U) << U.Name;
    }
    EXPECT_EQ(laneDepth(L), Sum);
  });
}

TEST(DatapathUnits, UnitsHaveTheNamesOfTheirOptions) {
  std::set<std::string_view> Names;
  for (const raster::ExpUnit &E : raster::ExpUnits) {
    const raster::LaneUnits L{raster::expRowOf(E.Option), 0};
    EXPECT_EQ(datapathUnits(L)[1].Name, E.Name);
    Names.insert(E.Name);
  }
  EXPECT_EQ(Names.size(), raster::ExpUnitCount);
}

TEST(DatapathUnits, ADividerIsAMultiplierWithRowsInsteadOfAProduct) {
  // Published areas: an fp32 multiplier, a bit of a product and of an adder.
  const double Product = 3495.0 / (32 * 32), Adder = 137.0 / 32;
  const DatapathUnit &Divider = backwardUnits(0).front();
  EXPECT_NEAR(area(Divider),
              7700 - 24 * 24 * Product + 26 * 24 * (Adder + 1.862) +
                  Divider.RegisterBits * 4.522,
              1e-6);
  // Stages there are between latencies, each with remainder and divisor.
  EXPECT_GE(Divider.RegisterBits, (Divider.Latency - 1) * 48);
}

TEST(DatapathUnits, AReciprocalTakesAPixelACycle) {
  // So it has a multiplier for each of its multiplications: the pair's spare
  // one, and its own.
  const std::map<std::string_view, unsigned> Multiplications{
      {"even-left", 4}, {"even-best", 4},  {"log-left", 4},
      {"log-best", 4},  {"mantissa-2", 4}, {"mantissa-3", 6}};
  for (const raster::ReciprocalUnit &R : raster::ReciprocalUnits) {
    const DatapathUnit &U = backwardUnits(R.Option).front();
    EXPECT_EQ(U.Interval, 1U) << R.Name;
    EXPECT_GT(U.RegisterBits, 0U) << R.Name;
    if (R.Option != 0)
      EXPECT_EQ(U.Multipliers + 1, Multiplications.at(R.Name)) << R.Name;
  }
  // Of as many multipliers, the deeper one has more registers.
  EXPECT_LT(area(backwardUnits(5).front()), area(backwardUnits(1).front()));
}

TEST(DatapathUnits, JsonHasTheParts) {
  const auto J = nlohmann::json::parse(areasJson());
  forAllLanes([&](raster::LaneUnits L) {
    EXPECT_NEAR(J["other"].get<double>() +
                    J["exp"][raster::ExpUnits[L.Exp].Option].get<double>() +
                    J["blend"][L.Blend].get<double>(),
                laneArea(L), 1e-6);
  });
  const auto &Reciprocals = J["reciprocal"];
  ASSERT_EQ(Reciprocals.size(), raster::ReciprocalUnitCount);
  for (std::size_t R = 0; R != Reciprocals.size(); ++R)
    EXPECT_NEAR(Reciprocals[R].get<double>(),
                area(backwardUnits(static_cast<unsigned>(R)).front()), 1e-6);
}

} // namespace
