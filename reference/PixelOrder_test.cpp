#include "PixelOrder.h"

#include "Projection.h"
#include "TestScenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace vorion::reference {
namespace {

/// Two sheets that cross in the middle of the picture: on the left the first is
/// in front, on the right the second. Their centres are 0.01 apart.
Gaussians<double> crossing() {
  const double Half = 0.3; // of the angle, either way about y
  Gaussians<double> G;
  for (const double Side : {-1.0, 1.0}) {
    G.Means.emplace_back(0, 0, 3 + 0.005 * Side);
    G.Scales.emplace_back(0.8, 0.8, 0.01);
    G.Quats.emplace_back(std::cos(Half), 0, -Side * std::sin(Half), 0);
    G.Opacities.push_back(0.9);
    G.Colors.emplace_back(Side < 0 ? 1 : 0, 0, Side < 0 ? 0 : 1);
  }
  return G;
}

Camera<double> ahead(double X) {
  Camera<double> C;
  C.Width = 40;
  C.Height = 30;
  C.Rotation = glm::dmat3(1);
  C.Centre = {X, 0, 0};
  C.Translation = {-X, 0, 0};
  C.Focal = {40, 40};
  C.Principal = {20, 15};
  return C;
}

TEST(PixelOrder, ByCentresItIsThePicture) {
  const auto G = crossing();
  const auto C = ahead(0);
  Options O;
  O.Background = {0.2, 0.3, 0.4};
  const auto S = project(G, C, O);
  const auto Want = blend(S, C.Width, C.Height, O);
  const auto Got =
      blendInOrder(S, C.Width, C.Height, O,
                   [&](std::size_t I, int, int) { return S[I].Depth; });
  EXPECT_EQ(Got.Turned, 0U);
  EXPECT_GT(Got.Pairs, 200U);
  for (std::size_t P = 0; P < Want.Render.size(); ++P)
    for (int K = 0; K < 3; ++K)
      EXPECT_NEAR(Got.Render[P][K], Want.Render[P][K], 1e-15);
}

TEST(PixelOrder, AlongTheRayEachSideHasItsOwnFront) {
  const auto G = crossing();
  const auto C = ahead(0);
  const Options O;
  const auto S = project(G, C, O);
  const PixelDepth Depth = depthAlongRay(G, C);
  // In the middle it is the centre's.
  EXPECT_NEAR(Depth(0, 20, 15), 2.995, 0.03);
  const auto R = blendInOrder(S, C.Width, C.Height, O, Depth);
  const auto At = [&](int X) { return R.Render[15 * 40 + X]; };
  const bool RedLeft = Depth(0, 12, 15) < Depth(1, 12, 15);
  EXPECT_NE(RedLeft, Depth(0, 27, 15) < Depth(1, 27, 15));
  EXPECT_GT(At(RedLeft ? 12 : 27).x, At(RedLeft ? 12 : 27).z);
  EXPECT_LT(At(RedLeft ? 27 : 12).x, At(RedLeft ? 27 : 12).z);
  // About half of all pixels turn their pair round.
  EXPECT_GT(R.Turned, R.Pairs / 3);
  EXPECT_LT(R.Turned, 2 * R.Pairs / 3);
}

// Where a sheet ends, its place along the ray is that of its plane: a' n / r' n
// for the normal n.
TEST(PixelOrder, AFlatOnesDepthIsThatOfItsPlane) {
  auto G = crossing();
  G.Scales[0].z = 0;
  const auto C = ahead(0);
  const double Angle = 2 * 0.3;
  const double Slope = (30.5 - 20) / 40;
  // The normal is the turned z.
  const double Nx = std::sin(Angle), Nz = std::cos(Angle);
  const double Want = 2.995 * Nz / (Slope * Nx + Nz);
  EXPECT_NEAR(depthAlongRay(G, C)(0, 30, 14), Want, 1e-2);
}

TEST(PixelOrder, WhatIsFullByOneOrderIsSeenByAnother) {
  Gaussians<double> G;
  for (int I = 0; I < 4; ++I) {
    G.Means.emplace_back(0, 0, 2 + I);
    G.Scales.emplace_back(9, 9, 9);
    G.Quats.emplace_back(1, 0, 0, 0);
    G.Opacities.push_back(1);
    G.Colors.emplace_back(I == 3 ? 1 : 0, 0, 0);
  }
  const auto C = ahead(0);
  const Options O;
  const auto S = project(G, C, O);
  EXPECT_LT(blend(S, C.Width, C.Height, O).Render[0].x, 1e-3);
  const auto R =
      blendInOrder(S, C.Width, C.Height, O,
                   [&](std::size_t I, int, int) { return -S[I].Depth; });
  EXPECT_GT(R.Render[0].x, 0.9);
  EXPECT_EQ(R.Turned, R.Pairs); // of those that were blended
}

} // namespace
} // namespace vorion::reference
