/// Blocks that tests leave of a box, against what is blended in them.
#include "raster/BlockTests.h"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <random>

using namespace vorion::raster;

namespace {

constexpr unsigned Side = BlockTests::Side, PerRow = VR_MAX_TILE / Side;
constexpr float MinAlpha = 1 / 255.0F;

/// A long, turned ellipse somewhere on the tile, with the box of its support.
Gaussian randomGaussian(std::mt19937 &Random) {
  const auto Draw = [&Random](float Low, float High) {
    return std::uniform_real_distribution<float>(Low, High)(Random);
  };
  Gaussian G{};
  G.Mean[0] = Draw(-4, 68);
  G.Mean[1] = Draw(-4, 68);
  const float Long = Draw(1, 20), Short = Draw(0.4F, Long),
              Turn = Draw(0, 3.1F);
  const float C = std::cos(Turn), S = std::sin(Turn);
  const float A = 1 / (Long * Long), B = 1 / (Short * Short);
  G.Conic[0] = A * C * C + B * S * S;
  G.Conic[1] = (A - B) * C * S;
  G.Conic[2] = A * S * S + B * C * C;
  G.Opacity = Draw(0.002F, 1);
  const float Radius =
      std::sqrt(std::max(0.0F, 2 * std::log(G.Opacity / MinAlpha)));
  G.Extent[0] = Radius * std::hypot(Long * C, Short * S);
  G.Extent[1] = Radius * std::hypot(Long * S, Short * C);
  return G;
}

struct Blocks {
  unsigned Box = 0, Changed = 0, Open = 0;
};

/// Of the box of \p Work: how many blocks there are, how many of them \p G has
/// changed, and how many had open pixels before, by \p Was.
Blocks counted(const BoxWork &Work, const TileBuffer &Was,
               const TileBuffer &Is) {
  Blocks Sum;
  for (unsigned Y = 0; Y != PerRow; ++Y)
    for (unsigned X = 0; X != PerRow; ++X) {
      bool InBox = false, Changed = false, Open = false;
      for (unsigned Row = Y * Side; Row != (Y + 1) * Side; ++Row)
        for (unsigned Column = X * Side; Column != (X + 1) * Side; ++Column) {
          const unsigned At = Row * TileBuffer::Stride + Column;
          InBox |= Column >= Work.X && Column < Work.X + Work.Width &&
                   Row >= Work.Y && Row < Work.Y + Work.Height;
          Changed |= Was.T[At] != Is.T[At] ||
                     std::signbit(Was.T[At]) != std::signbit(Is.T[At]);
          Open |= !std::isnan(Is.CentreX[Column]) &&
                  !std::isnan(Is.CentreY[Row]) && !std::signbit(Was.T[At]);
        }
      Sum.Box += InBox;
      Sum.Changed += Changed;
      Sum.Open += InBox && Open;
    }
  return Sum;
}

/// Blends 400 Gaussians into a tile and calls \p Check for each one that does
/// not miss it.
template <typename Function>
void blendMany(unsigned Which, unsigned Width, unsigned Height,
               Function Check) {
  std::mt19937 Random(Which * 100 + Width);
  const auto Tile = std::make_unique<TileBuffer>(),
             Was = std::make_unique<TileBuffer>();
  Tile->reset(0, 0, Width, Height);
  BlockTests Tests(Which);
  const BlendOptions Options{1e-4F, MinAlpha, false};
  for (unsigned N = 0; N != 400; ++N) {
    const Gaussian G = randomGaussian(Random);
    *Was = *Tile;
    const BoxWork Work = datapaths().back()->Conics.Of[0][0](G, Options, *Tile);
    if (!Work.Clipped)
      Check(Work, Tests.count(G, Work, MinAlpha, *Tile),
            counted(Work, *Was, *Tile));
  }
}

TEST(BlockTests, LeaveEveryBlockThatIsBlended) {
  for (const unsigned Which : {1U, 2U, 3U})
    for (const auto &[Width, Height] : {std::pair{64, 64}, {37, 18}})
      blendMany(Which, Width, Height,
                [&](const BoxWork &, BlockWork Left, const Blocks &All) {
                  EXPECT_GE(Left.Blocks, All.Changed) << Which;
                  EXPECT_LE(Left.Blocks, All.Box) << Which;
                });
}

TEST(BlockTests, LeaveFewOutsideOfTheEllipse) {
  unsigned Box = 0, Left = 0, Changed = 0;
  // Of the first ones, where all pixels are open.
  unsigned Seen = 0;
  blendMany(OutsideEllipse, 64, 64,
            [&](const BoxWork &, BlockWork Work, const Blocks &All) {
              if (++Seen > 10)
                return;
              Box += All.Box;
              Left += Work.Blocks;
              Changed += All.Changed;
            });
  EXPECT_LT(Left, 0.8 * Box);
  EXPECT_LT(Left, 1.15 * Changed);
}

TEST(BlockTests, LeaveOutExactlyTheClosedBlocks) {
  unsigned Closed = 0;
  blendMany(ClosedBlock, 40, 24,
            [&](const BoxWork &, BlockWork Left, const Blocks &All) {
              EXPECT_EQ(Left.Blocks, All.Open);
              Closed += All.Box - All.Open;
            });
  EXPECT_GT(Closed, 100U);
}

TEST(BlockTests, CountTheBoxsPixels) {
  const auto Tile = std::make_unique<TileBuffer>();
  Tile->reset(0, 0, 64, 64);
  Gaussian G{};
  G.Mean[0] = G.Mean[1] = 8;
  G.Conic[0] = G.Conic[2] = 1e-6F;
  G.Opacity = 1;
  G.Extent[0] = 5;
  G.Extent[1] = 3;
  const BoxWork Work =
      datapaths().back()->Conics.Of[0][0](G, {1e-4F, MinAlpha, false}, *Tile);
  BlockTests Tests(OutsideEllipse);
  const BlockWork Left = Tests.count(G, Work, MinAlpha, *Tile);
  EXPECT_EQ(Left.Blocks, 4 * 2);
  EXPECT_EQ(Left.Pixels, 10 * 6);
}

TEST(BlockTests, WhatIsNoEllipseLeavesAll) {
  const auto Tile = std::make_unique<TileBuffer>();
  for (const float B : {2.0F, -2.0F, INFINITY}) {
    Tile->reset(0, 0, 64, 64);
    Gaussian G{};
    G.Mean[0] = G.Mean[1] = 32;
    G.Conic[0] = G.Conic[2] = 1;
    G.Conic[1] = B;
    G.Opacity = 0.5F;
    G.Extent[0] = G.Extent[1] = INFINITY;
    const BoxWork Work =
        datapaths().back()->Conics.Of[0][0](G, {1e-4F, MinAlpha, false}, *Tile);
    BlockTests Tests(OutsideEllipse);
    EXPECT_EQ(Tests.count(G, Work, MinAlpha, *Tile).Blocks, PerRow * PerRow);
  }
}

} // namespace
