// Triangles in pictures whose answer is known in closed form.
#include "Mesh.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion::reference;

namespace {

/// 64x48 pixels, focal length 50 px, at the origin along +z.
Camera<double> camera() {
  Camera<double> C;
  C.Width = 64;
  C.Height = 48;
  C.Rotation = glm::dmat3(1);
  C.Translation = C.Centre = glm::dvec3(0);
  C.Focal = {50, 50};
  C.Principal = {32, 24};
  return C;
}

/// A square in the plane z = \p Z from -1 to 1, with a picture on it.
Mesh square(double Z) {
  Mesh M;
  M.Positions = {{-1, -1, Z}, {1, -1, Z}, {1, 1, Z}, {-1, 1, Z}};
  M.Colors.assign(4, glm::dvec4(1));
  M.Corners = {0, 1, 2, 0, 2, 3};
  M.Coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  M.Looks.resize(1);
  M.LookOf = {0, 0};
  return M;
}

/// 4x4 texels, black and white in turn, and their mean.
Texture checkers() {
  Texture T;
  for (int Size = 4; Size > 0; Size /= 2) {
    auto &L = T.Levels.emplace_back();
    L.Width = L.Height = Size;
    for (int I = 0; I < Size * Size; ++I)
      L.Texels.push_back(Size == 4 ? glm::dvec4((I + I / 4) % 2)
                                   : glm::dvec4(0.735, 0.735, 0.735, 0.5));
  }
  return T;
}

TEST(MeshView, ASquareCoversItsPixelsOnceAtItsDepth) {
  const MeshView V = viewOf(square(2.5), camera(), {});
  // From -1 / 2.5 * 50 + 32 = 12 to 52, and 4 to 44.
  for (int Y = 0; Y < 48; ++Y)
    for (int X = 0; X < 64; ++X) {
      const auto I = static_cast<std::size_t>(64 * Y + X);
      const bool IsInside = X >= 12 && X < 52 && Y >= 4 && Y < 44;
      EXPECT_EQ(V.Triangles[I] >= 0, IsInside) << X << "," << Y;
      if (IsInside)
        EXPECT_NEAR(V.Depths[I], 2.5, 1e-12);
      // The diagonal goes through the centres of pixels.
      EXPECT_EQ(V.Doubtful[I], IsInside && X - 12 == Y - 4) << X << "," << Y;
    }
}

TEST(MeshView, TheNearPlaneCutsAndTheNearestIsSeen) {
  Mesh M = square(2.5);
  // A floor from behind the camera on, 0.5 below it.
  const auto First = static_cast<uint32_t>(M.Positions.size());
  for (const glm::dvec3 P :
       {glm::dvec3(-9, 0.5, -9), {9, 0.5, -9}, {0, 0.5, 99}})
    M.Positions.push_back(P);
  M.Corners.insert(M.Corners.end(), {First, First + 1, First + 2});
  M.Colors.resize(7, glm::dvec4(1));
  M.Coordinates.resize(9);
  M.LookOf.push_back(0);
  const MeshView V = viewOf(M, camera(), {});
  // In row 36, 12.5 below the axis, the floor is at depth 2.
  EXPECT_EQ(V.Triangles[64 * 36 + 32], 2);
  EXPECT_NEAR(V.Depths[64 * 36 + 32], 2, 1e-12);
  // In row 30 it is at 50 * 0.5 / 6.5 = 3.8, behind the square.
  EXPECT_LT(V.Triangles[64 * 30 + 32], 2);
}

TEST(MeshColor, TexelsAreStoredValuesAndBlendedInLinearLight) {
  Mesh M = square(2.5);
  M.Textures.push_back(checkers());
  M.Looks[0].Picture = 0;
  // 10 pixels a texel; the middle of the second one, then the edge between.
  EXPECT_NEAR(colorOf(M, camera(), 0, {27, 9}).Rgba.x, 1, 1e-12);
  EXPECT_NEAR(colorOf(M, camera(), 0, {22, 9}).Rgba.x,
              1.055 * std::pow(0.5, 1 / 2.4) - 0.055, 1e-12);
  M.Looks[0].MagnifiesLinearly = false;
  EXPECT_EQ(colorOf(M, camera(), 0, {21.5, 9.5}).Rgba.x, 0);
  EXPECT_NEAR(colorOf(M, camera(), 0, {22.5, 9.5}).Rgba.x, 1, 1e-12);
  EXPECT_TRUE(colorOf(M, camera(), 0, {22, 9}).Doubtful);
  // Mirrored, the texel before the first is the first.
  for (glm::dvec2 &At : M.Coordinates)
    At -= glm::dvec2(1, 0);
  M.Looks[0].Edges[0] = MeshLook::Edge::Mirror;
  EXPECT_NEAR(colorOf(M, camera(), 0, {17.5, 9.5}).Rgba.x, 1, 1e-12);
  M.Looks[0].Edges[0] = MeshLook::Edge::Repeat;
  EXPECT_EQ(colorOf(M, camera(), 0, {17.5, 9.5}).Rgba.x, 0);
}

TEST(MeshColor, SmallTexelsComeFromSmallerLevels) {
  // 40 pixels have 8 * 40 / 4 = 80 repetitions: 8 texels a pixel, level 3.
  Mesh M = square(2.5);
  M.Textures.push_back(checkers());
  M.Looks[0].Picture = 0;
  for (glm::dvec2 &At : M.Coordinates)
    At *= 80;
  EXPECT_NEAR(colorOf(M, camera(), 0, {30, 20}).Rgba.x, 0.735, 1e-9);
  // Two texels a pixel are level 1, and 1.5 are between levels.
  for (glm::dvec2 &At : M.Coordinates)
    At /= 4;
  EXPECT_NEAR(colorOf(M, camera(), 0, {30, 20}).Rgba.x, 0.735, 1e-9);
  M.Looks[0].Levels = MeshLook::Mips::None;
  EXPECT_GT(std::abs(colorOf(M, camera(), 0, {30.1, 20.1}).Rgba.x - 0.735),
            0.01);
}

TEST(MeshColor, LightFollowsTheCosineOnTheSideThatIsSeen) {
  Mesh M = square(2.5);
  M.Light = glm::normalize(glm::dvec3(0, 1, 1));
  const double Half = 0.2 + 0.8 * std::sqrt(0.5);
  EXPECT_NEAR(colorOf(M, camera(), 0, {30, 20}).Rgba.x,
              1.055 * std::pow(Half, 1 / 2.4) - 0.055, 1e-12);
  // From behind there is only the light from everywhere.
  M.Light = glm::dvec3(0, 0, -1);
  EXPECT_NEAR(colorOf(M, camera(), 0, {30, 20}).Rgba.x,
              1.055 * std::pow(0.2, 1 / 2.4) - 0.055, 1e-12);
  // Normals of the file count, on the side that is seen.
  M.Normals.assign(6, glm::dvec3(0, 1, 1));
  M.Light = glm::normalize(glm::dvec3(0, 1, 1));
  EXPECT_NEAR(colorOf(M, camera(), 0, {30, 20}).Rgba.x, 1, 1e-12);
}

TEST(MeshView, WhatIsMaskedIsNotSeen) {
  Mesh M = square(2.5);
  M.Looks.push_back(M.Looks[0]);
  M.Looks[1].Cutoff = 0.5;
  M.LookOf = {1, 1};
  for (glm::dvec4 &C : M.Colors)
    C.w = 0.4;
  EXPECT_EQ(viewOf(M, camera(), {}).Triangles[64 * 20 + 30], -1);
  for (glm::dvec4 &C : M.Colors)
    C.w = 0.6;
  EXPECT_GE(viewOf(M, camera(), {}).Triangles[64 * 20 + 30], 0);
}

} // namespace
