#include "analyze/Chart.h"
#include "analyze/Plots.h"

#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

std::size_t count(const std::string &Text, const std::string &What) {
  std::size_t Found = 0;
  for (std::size_t At = Text.find(What); At != std::string::npos;
       At = Text.find(What, At + 1))
    ++Found;
  return Found;
}

TEST(Chart, BarsAndLinesStandWhereTheirValuesAre) {
  Chart C{"A < B", "x", "y", {"one", "two"}, 1, {{"s", {0, 5}}}, true};
  const std::string Bars = svgOf(C);
  // From 44 (the largest, 5) to 352 (zero), in the middle of each half.
  EXPECT_NE(Bars.find("y=\"44.0\" width=\"214.4\" height=\"308.0\""),
            std::string::npos)
      << Bars;
  EXPECT_NE(Bars.find("y=\"352.0\" width=\"214.4\" height=\"0.0\""),
            std::string::npos);
  EXPECT_NE(Bars.find("A &lt; B"), std::string::npos);
  C.Bars = false;
  EXPECT_NE(svgOf(C).find("points=\"220.0,352.0 488.0,44.0 \""),
            std::string::npos);
}

TEST(Chart, TheAxisEndsAtARoundNumber) {
  const std::pair<double, std::string> Ends[] = {
      {0, "1"},     {1, "1"},     {1.01, "1.25"},    {99, "100"},
      {101, "125"}, {126, "150"}, {260000, "300000"}};
  for (const auto &[Largest, End] : Ends) {
    const Chart C{"", "", "", {"p"}, 1, {{"s", {Largest}}}, true};
    // The uppermost line's number.
    EXPECT_NE(svgOf(C).find("y=\"48.0\" text-anchor=\"end\">" + End + "<"),
              std::string::npos)
        << Largest << svgOf(C);
  }
}

TEST(Chart, AnAnalysisHasThree) {
  Analysis A;
  for (ListStatistics &L : A.Lists) {
    L.Tiles = 4;
    L.Histogram = {1, 3};
    L.Occluded.fill(0.5);
  }
  const auto Charts = chartsOf(A, "front");
  ASSERT_EQ(Charts.size(), 3U);
  EXPECT_EQ(count(svgOf(Charts.at("invocations")), "<rect"), 1U + 16);
  EXPECT_EQ(count(svgOf(Charts.at("occlusion")), "<polyline"), 2U);
  EXPECT_EQ(count(svgOf(Charts.at("lists")), "<rect"), 1U + 4);
}

} // namespace
