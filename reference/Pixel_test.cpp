#include "Pixel.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

using namespace vorion::reference;

namespace {

TEST(Pixel, ItsGaussiansMakeThePicture) {
  constexpr int Width = 40, Height = 24;
  const auto Splats = project(randomGaussians(200, 7),
                              frontCamera(Width, Height, 30), Options());
  const auto P = blend(Splats, Width, Height, Options());
  std::size_t Blends = 0;
  for (int Y = 0; Y < Height; ++Y)
    for (int X = 0; X < Width; ++X) {
      glm::dvec3 Color(0);
      double Rest = 1;
      const auto Found = contributors(Splats, Width, Height, Options(), X, Y);
      for (const auto &C : Found) {
        Color += Splats[static_cast<std::size_t>(C.Index)].Color * C.Weight;
        EXPECT_NEAR(C.Weight, Rest * C.Alpha, 1e-15);
        Rest *= 1 - C.Alpha;
      }
      const std::size_t At = std::size_t(Width) * Y + X;
      EXPECT_EQ(P.Render[At], Color);
      EXPECT_EQ(Found.empty() ? -1 : Found.back().Index, P.Last[At]);
      Blends += Found.size();
    }
  EXPECT_EQ(Blends, P.Blends);
  EXPECT_GT(Blends, 0U);
}

} // namespace
