#include "page/Chart.h"

#include "analyze/Plots.h"

#include <fmt/format.h>
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
  Chart C{"A < B\n", "x", "y", {"one", "two"}, 1, {{"s", {0, 5}}}, true, {}};
  const std::string Bars = svgOf(C);
  // From the plot's top (the largest, 5) down 290 (zero), of each half 0.8.
  EXPECT_NE(Bars.find("y=\"46.0\" width=\"265.6\" height=\"290.0\""),
            std::string::npos)
      << Bars;
  EXPECT_NE(Bars.find("y=\"336.0\" width=\"265.6\" height=\"0.0\""),
            std::string::npos);
  EXPECT_NE(Bars.find("A &lt; B\\x0a"), std::string::npos);
  C.Bars = false;
  EXPECT_NE(svgOf(C).find("points=\"246.0,336.0 578.0,46.0 \""),
            std::string::npos)
      << svgOf(C);
}

TEST(Chart, TheAxisEndsAtARoundNumber) {
  const std::pair<double, std::string> Ends[] = {
      {0, "1"},     {1, "1"},     {1.01, "1.25"},    {99, "100"},
      {101, "125"}, {126, "150"}, {260000, "300000"}};
  for (const auto &[Largest, End] : Ends) {
    const Chart C{"", "", "", {"p"}, 1, {{"s", {Largest}}}, true, {}};
    // The uppermost line's number.
    EXPECT_NE(svgOf(C).find("y=\"50.0\" text-anchor=\"end\" class=\"soft\">" +
                            End + "<"),
              std::string::npos)
        << Largest << svgOf(C);
  }
}

TEST(Chart, NumbersAlongXAreRound) {
  Chart C{"", "", "", {}, 1, {{"s", {3, 2, 1}}}, false, {}, {}, 0};
  for (const auto &[Last, Texts] :
       {std::pair(4.0, std::vector<std::string>{"0", "1", "2", "3", "4"}),
        {1000, {"0", "200", "400", "600", "800", "1000"}},
        {6990, {"0", "2000", "4000", "6000"}},
        {12, {"0", "5", "10"}},
        {1, {"0", "1"}}}) {
    C.Numbers = {Last / 4, Last / 2, 0.9 * Last};
    C.NumbersEnd = Last;
    const std::string Svg = svgOf(C);
    std::string Label;
    for (const std::string &Text : Texts) {
      const double X = 80 + std::stod(Text) / Last * (744 - 80);
      Label = fmt::format("<text x=\"{:.1f}\" y=\"354.0\" "
                          "text-anchor=\"middle\" class=\"soft\">{}</text>",
                          X, Text);
      EXPECT_NE(Svg.find(Label), std::string::npos) << Label << Svg;
    }
    EXPECT_EQ(count(Svg, "text-anchor=\"middle\" class=\"soft\""),
              Texts.size());
    // A number stands where it says.
    EXPECT_NE(Svg.find("points=\"246.0,"), std::string::npos) << Svg;
    EXPECT_NE(Svg.find("677.6,"), std::string::npos) << Svg;
  }
}

TEST(Chart, ColoursAreThoseOfThePagesLightAndDark) {
  const std::string Sheet(lookSheet());
  const Chart C{"", "", "", {"p"}, 1, {{"a", {1}}, {"b", {2}}}, false, {}};
  const std::string Svg = svgOf(C);
  const std::size_t Dark = Svg.find("prefers-color-scheme: dark");
  ASSERT_NE(Dark, std::string::npos);
  const std::size_t DarkOfSheet = Sheet.find("prefers-color-scheme: dark");
  const auto Value = [&](const std::string &Name, std::size_t From) {
    const std::size_t At = Sheet.find(Name + ": ", From) + Name.size() + 2;
    return Sheet.substr(At, Sheet.find_first_of("; ", At) - At);
  };
  for (const auto &[Rule, Name] : {std::pair(".ink { fill: ", "--ink"),
                                   {".panel { fill: ", "--panel"},
                                   {".line0 { stroke: ", "--series"}}) {
    EXPECT_LT(Svg.find(Rule + Value(Name, 0) + ";"), Dark) << Rule;
    EXPECT_NE(Svg.find(Rule + Value(Name, DarkOfSheet) + ";", Dark),
              std::string::npos)
        << Rule;
  }
  EXPECT_NE(Value("--ink", 0), Value("--ink", DarkOfSheet));
}

TEST(Chart, LongTextsAreNotCutOff) {
  const std::string Long(200, 'w');
  const Chart C{Long + " " + Long,
                "",
                "",
                {Long, "b"},
                1,
                {{"first " + Long.substr(0, 60), {1, 2}},
                 {"second " + Long.substr(0, 60), {2, 1}}},
                false,
                {Long}};
  const std::string Svg = svgOf(C);
  // 3 + 3 lines of the title, 3 of the foot; a line each in the legend.
  EXPECT_EQ(count(Svg, "class=\"title ink\""), 6U);
  EXPECT_EQ(count(Svg, "class=\"made soft\""), 3U);
  EXPECT_EQ(count(Svg, "x=\"112.0\""), 2U);
  EXPECT_NE(Svg.find("rotate(-40)"), std::string::npos);
}

TEST(Chart, AnAnalysisHasThree) {
  Analysis A;
  for (ListStatistics &L : A.Lists) {
    L.Tiles = 4;
    L.Histogram = {1, 3};
    L.Occluded.fill(0.5);
  }
  const auto Charts = chartsOf(A);
  ASSERT_EQ(Charts.size(), 3U);
  EXPECT_EQ(count(svgOf(Charts.at("invocations")), "<rect"), 1U + 16 + 4);
  EXPECT_EQ(count(svgOf(Charts.at("occlusion")), "<polyline"), 2U);
  EXPECT_EQ(count(svgOf(Charts.at("lists")), "<rect"), 1U + 4 + 2);
}

} // namespace
