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

// A glass is one of the contributions, and a wall gets what is left.
TEST(Pixel, SurfacesAreInTheirPlaces) {
  constexpr int Width = 40, Height = 24;
  const auto Splats = project(randomGaussians(200, 7),
                              frontCamera(Width, Height, 30), Options());
  constexpr std::size_t Pixels = std::size_t{Width} * Height;
  const Layer<double> Glass{1.1, {0.2, 0.9, 0.4}, 0.25};
  const Surface<double> All{.Depths = std::vector(Pixels, 2.0),
                            .Colors = std::vector(Pixels, glm::dvec3(0.5)),
                            .Slack = {},
                            .Doubtful = {},
                            .Layers = std::vector(Pixels, std::vector{Glass})};
  const Surface<double> Own{.Depths = {2.0},
                            .Colors = {},
                            .Slack = {},
                            .Doubtful = {},
                            .Layers = {{Glass}}};
  const auto P = blend(Splats, Width, Height, Options(), &All);
  std::size_t InFront = 0, Behind = 0;
  for (int Y = 0; Y < Height; ++Y)
    for (int X = 0; X < Width; ++X) {
      glm::dvec3 Color(0);
      double Rest = 1;
      std::size_t Glasses = 0;
      for (const auto &C :
           contributors(Splats, Width, Height, Options(), X, Y, &Own)) {
        EXPECT_NEAR(C.Weight, Rest * C.Alpha, 1e-15);
        Rest *= 1 - C.Alpha;
        if (C.IsLayer) {
          Color += Glass.Color * C.Weight;
          ++Glasses;
          continue;
        }
        const auto &Of = Splats[static_cast<std::size_t>(C.Index)];
        Color += Of.Color * C.Weight;
        EXPECT_EQ(Glasses == 0, Of.Depth < Glass.Depth);
        EXPECT_LT(Of.Depth, 2);
        ++(Glasses == 0 ? InFront : Behind);
      }
      EXPECT_EQ(Glasses, 1U);
      Color += 0.5 * Rest;
      for (int K = 0; K < 3; ++K)
        EXPECT_NEAR(P.Render[std::size_t(Width) * Y + X][K], Color[K], 1e-14);
    }
  EXPECT_GT(InFront, 0U);
  EXPECT_GT(Behind, 0U);
}

} // namespace
