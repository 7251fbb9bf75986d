#include "TestScenes.h"
#include "Tiles.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace vorion::reference;

namespace {

Splat<double> boxAt(double X, double Y, double Ex, double Ey) {
  Splat<double> S;
  S.Visible = true;
  S.Mean = {X, Y};
  S.Extent = {Ex, Ey};
  return S;
}

void expectRect(const Rect &R, int X0, int Y0, int X1, int Y1) {
  EXPECT_EQ(R.X0, X0);
  EXPECT_EQ(R.Y0, Y0);
  EXPECT_EQ(R.X1, X1);
  EXPECT_EQ(R.Y1, Y1);
}

TEST(Tiles, GridCoversPartialTiles) {
  const TileGrid G(64, 960, 544);
  EXPECT_EQ(G.Columns, 15);
  EXPECT_EQ(G.Rows, 9);
}

TEST(Tiles, BoxesMeetTileAreas) {
  const TileGrid G(16, 64, 48);
  const auto Of = [&](const Splat<double> &S) {
    return tilesOf(S, Support::Box3, G);
  };
  expectRect(Of(boxAt(24, 24, 4, 4)), 1, 1, 2, 2);
  expectRect(Of(boxAt(24, 24, 8, 7.99)), 1, 1, 3, 2); // right edge at 32
  expectRect(Of(boxAt(24, 24, 8.01, 4)), 0, 1, 3, 2);
  expectRect(Of(boxAt(24, 24, 1e9, 1e300)), 0, 0, 4, 3);
  const Rect Left = Of(boxAt(-10, 24, 9, 4));
  EXPECT_EQ(Left.X0, 0);
  EXPECT_EQ(Left.X1, 0); // empty
  const Rect Right = Of(boxAt(80, 24, 9, 4));
  EXPECT_GE(Right.X0, Right.X1);
  const double Nan = std::numeric_limits<double>::quiet_NaN();
  const Rect None = Of(boxAt(Nan, 24, 9, 4));
  EXPECT_GE(None.X0, None.X1);
}

TEST(Tiles, WhatOnlyTheLastTilesRestSeesIsOutside) {
  const TileGrid G(64, 100, 70); // 28 and 58 px of the last tiles are no pixels
  const auto Of = [&](double X, double Y) {
    return tilesOf(boxAt(X, Y, 4, 4), Support::Exact, G);
  };
  expectRect(Of(103.9, 73.9), 1, 1, 2, 2);
  for (const Rect &R : {Of(104, 40), Of(40, 74), Of(110, 100)}) {
    EXPECT_GE(R.X0, R.X1);
    EXPECT_GE(R.Y0, R.Y1);
  }
}

TEST(Tiles, OfficialTilesCountPixelsAtIntegers) {
  // m = 23.5, r = 8: floor(15.5 / 16) = 0 to floor(46.5 / 16) = 2.
  expectRect(officialPixels(glm::dvec2(24, 24), 8., 64, 48), 0, 0, 32, 32);
  // m = 24, r = 8: floor(1) = 1 to floor(47 / 16) = 2.
  expectRect(officialPixels(glm::dvec2(24.5, 24.5), 8., 64, 48), 16, 16, 32,
             32);
  // The picture's last tile is partial.
  expectRect(officialPixels(glm::dvec2(60, 40), 3., 60, 40), 48, 32, 60, 40);
}

TEST(Tiles, OfficialTilesOfAnotherSizeHoldTheSamePixels) {
  const auto S = boxAt(24, 24, 8, 8);
  expectRect(tilesOf(S, Support::Official16, TileGrid(16, 64, 48)), 0, 0, 2, 2);
  expectRect(tilesOf(S, Support::Official16, TileGrid(64, 64, 48)), 0, 0, 1, 1);
}

TEST(Tiles, ListsAreSortedByDepthBitsThenIndex) {
  std::vector<Splat<double>> Splats(4, boxAt(8, 8, 2, 2));
  Splats[0].Depth = 2;
  Splats[1].Depth = 1 + 1e-12; // the same fp32 number as 1
  Splats[2].Depth = 1;
  Splats[3].Depth = 0.5;
  Splats.push_back(Splats[0]);
  Splats[4].Visible = false;
  const auto T = tileLists(Splats, Support::Box3, 16, 16, 16);
  ASSERT_EQ(T.Lists.size(), 1U);
  EXPECT_EQ(T.Lists[0], (std::vector<uint32_t>{3, 1, 2, 0}));
  EXPECT_EQ(T.pairs(), 4U);
  EXPECT_EQ(sortKey(3, 1.0), 0x3'3f800000U);
}

TEST(Tiles, EveryPixelThatCountsIsInAList) {
  const auto C = frontCamera(75, 53, 60);
  const auto G = randomGaussians(300, 1);
  Options O;
  const auto Splats = project(G, C, O);
  for (const int Size : {16, 64}) {
    const auto T = tileLists(Splats, Support::Exact, Size, C.Width, C.Height);
    for (uint32_t I = 0; I < Splats.size(); ++I) {
      const auto &S = Splats[I];
      for (int Y = 0; S.Visible && Y < C.Height; ++Y)
        for (int X = 0; X < C.Width; ++X) {
          const double Dx = S.Mean.x - X - 0.5, Dy = S.Mean.y - Y - 0.5;
          const double Q = S.Conic[0] * Dx * Dx + S.Conic[2] * Dy * Dy +
                           2 * S.Conic[1] * Dx * Dy;
          if (S.Opacity * std::exp(-Q / 2) < 1.0000001 / 255)
            continue;
          const auto &List = T.Lists[T.Grid.index(X / Size, Y / Size)];
          ASSERT_NE(std::find(List.begin(), List.end(), I), List.end());
        }
    }
  }
}

} // namespace
