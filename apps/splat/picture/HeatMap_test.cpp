#include "picture/HeatMap.h"

#include "io/TestFiles.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::splat;

namespace {

/// Two depth parts of a tile, the pixel unit's rest of one, and a tile to the
/// right, written first.
const std::string Lines =
    R"({"unit": "rasterizer", "x": 64, "y": 0, "width": 36, "height": 50,
 "begin": 100, "end": 150, "list": 3, "blends": 9, "saturated": 0})"
    "\n"
    R"({"unit": "rasterizer", "x": 0, "y": 0, "width": 64, "height": 50,
 "begin": 10, "end": 110, "list": 5, "blends": 40, "saturated": 800})"
    "\n"
    R"({"unit": "rasterizer", "x": 0, "y": 0, "width": 64, "height": 50,
 "begin": 200, "end": 260, "list": 7, "blends": 20, "saturated": 0})"
    "\n"
    R"({"unit": "pixel unit", "x": 0, "y": 0, "width": 64, "height": 50,
 "begin": 260, "end": 300, "list": 2, "blends": 4, "saturated": 800})"
    "\n";

/// A line is one line, and names its machine.
std::string asLines(std::string Text) {
  for (std::size_t At = 0; (At = Text.find(",\n", At)) != std::string::npos;)
    Text.erase(At + 1, 1);
  constexpr std::string_view Machine =
      R"("machine": "prototype", "clock_mhz": 530, "clock_version": 3, )";
  for (std::size_t At = 0; (At = Text.find('{', At)) != std::string::npos;)
    Text.insert(++At, Machine);
  return Text;
}

DrawnTiles drawn() {
  const TestFolder Folder;
  auto T = readTileWork(Folder.write("tiles", asLines(Lines)));
  EXPECT_TRUE(T) << T.error().What;
  return T ? *T : DrawnTiles();
}

std::array<float, 3> pixel(const Image &I, int X, int Y) {
  const float *At = I.Render.data() + 3 * (Y * I.Width + X);
  return {At[0], At[1], At[2]};
}

TEST(HeatMap, CommandsOfATileAddUp) {
  const auto All = drawn().Tiles;
  ASSERT_EQ(All.size(), 2U);
  EXPECT_EQ(All[0].X, 0);
  EXPECT_EQ(All[0].List, 12U);
  EXPECT_EQ(All[0].Blends, 64U);
  EXPECT_EQ(All[0].Cycles, 160U);
  EXPECT_EQ(All[0].PixelUnitCycles, 40U);
  EXPECT_EQ(valueOf(All[0], Heat::Saturation), 25);
  EXPECT_EQ(All[1].X, 64);
  EXPECT_EQ(valueOf(All[1], Heat::Saturation), 0);
  EXPECT_EQ(scaleOf(All, Heat::Cycles), 160);
  EXPECT_EQ(scaleOf(All, Heat::Saturation), 100);
}

TEST(HeatMap, ATileHasTheColourOfItsValueAndTheLegendHasAll) {
  const Image I = drawHeat(drawn().Tiles, Heat::Saturation, 100, 60);
  EXPECT_EQ(I.Width, 100);
  EXPECT_EQ(I.Height, 60 + LegendHeight);
  // No value, and no tile.
  EXPECT_EQ(pixel(I, 99, 0), pixel(I, 64, 49));
  EXPECT_NE(pixel(I, 99, 0), pixel(I, 0, 0));
  EXPECT_EQ(pixel(I, 0, 50), pixel(I, 99, 59));
  EXPECT_NE(pixel(I, 0, 50), pixel(I, 99, 0));
  // A quarter up the scale's colours, somewhere in the legend.
  bool Found = false;
  for (int X = 0; X != I.Width; ++X)
    Found |= pixel(I, X, 60 + LegendHeight / 2) == pixel(I, 64, 0);
  EXPECT_TRUE(Found);
  // Nothing to show is no division by 0.
  EXPECT_EQ(
      pixel(drawHeat({{.Width = 1, .Height = 1}}, Heat::List, 1, 1), 0, 0),
      pixel(I, 99, 0));
}

TEST(HeatMap, TheReportHasEveryTile) {
  const auto J = heatJson(drawn());
  EXPECT_EQ(J["clocked_machine"], "prototype, 530 MHz, clock version 3");
  EXPECT_EQ(J["scales"]["list"], 12);
  EXPECT_EQ(J["tiles"].size(), 2U);
  EXPECT_EQ(J["tiles"][0]["saturation"], 25);
  EXPECT_EQ(J["tiles"][1]["cycles"], 50);
}

TEST(HeatMap, WhateverElseAFileHoldsIsRefused) {
  const TestFolder Folder;
  EXPECT_FALSE(readTileWork(Folder.path("none")));
  for (const char *Text : {"{", "{}\n", "[]\n", "1\n", "{\"x\": 1}\n"})
    EXPECT_FALSE(readTileWork(Folder.write("t", Text))) << Text;
}

} // namespace
