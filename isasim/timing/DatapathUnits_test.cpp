// Depths and areas of a rasterizer's lane against their definitions.
#include "timing/DatapathUnits.h"

#include "raster/BlendUnits.h"
#include "raster/ExpUnits.h"
#include "raster/Reciprocals.h"

#include <gtest/gtest.h>
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
  EXPECT_LT(laneArea({raster::VR_EXP_SCHRAUDOLPH, 0}),
            laneArea({raster::VR_EXP_TABLE, 0}));
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
  for (const raster::ExpUnit &E : raster::expUnits()) {
    const raster::LaneUnits L{static_cast<uint8_t>(E.Option), 0};
    EXPECT_EQ(datapathUnits(L)[1].Name, E.Name);
    Names.insert(E.Name);
  }
  EXPECT_EQ(Names.size(), raster::ExpUnitCount);
}

TEST(DatapathUnits, JsonHasTheParts) {
  const auto J = nlohmann::json::parse(areasJson());
  forAllLanes([&](raster::LaneUnits L) {
    EXPECT_NEAR(J["other"].get<double>() + J["exp"][L.Exp].get<double>() +
                    J["blend"][L.Blend].get<double>(),
                laneArea(L), 1e-6);
  });
  const auto &Reciprocals = J["reciprocal"];
  ASSERT_EQ(Reciprocals.size(), raster::ReciprocalCount);
  for (std::size_t R = 0; R != Reciprocals.size(); ++R)
    EXPECT_NEAR(Reciprocals[R].get<double>(),
                area(backwardUnits(static_cast<unsigned>(R)).front()), 1e-6);
}

} // namespace
