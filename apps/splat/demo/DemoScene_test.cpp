#include "demo/DemoScene.h"

#include "demo/ShFit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace vorion::splat::demo {
namespace {

TEST(DemoScene, IsTheSameEveryTime) {
  const Scene A = makeScene(2000), B = makeScene(2000);
  EXPECT_EQ(A.Means, B.Means);
  EXPECT_EQ(A.Sh, B.Sh);
}

TEST(DemoScene, HasAboutAsManyGaussiansAsAskedFor) {
  for (const int Count : {2000, 10000}) {
    const auto Made = static_cast<double>(makeScene(Count).size());
    EXPECT_NEAR(Made / Count, 1, 0.1) << Count;
  }
}

TEST(DemoScene, IsFiniteAndUsesAllBands) {
  const Scene S = makeScene(2000);
  const auto Finite = [](float V) { return std::isfinite(V); };
  EXPECT_TRUE(std::ranges::all_of(S.Means, Finite));
  EXPECT_TRUE(std::ranges::all_of(S.LogScales, Finite));
  EXPECT_TRUE(std::ranges::all_of(S.Quats, Finite));
  EXPECT_TRUE(std::ranges::all_of(S.OpacityLogits, Finite));
  EXPECT_TRUE(std::ranges::all_of(S.Sh, Finite));
  // The last coefficient of band 3 matters to some Gaussian.
  float Largest = 0;
  for (std::size_t I = 0; I < S.size(); ++I)
    Largest = std::max(Largest, std::abs(S.Sh[(I + 1) * 48 - 1]));
  EXPECT_GT(Largest, 0.02F);
}

TEST(ShFit, GivesBackALinearColour) {
  // Bands 0 and 1 hold it exactly; damping takes a little.
  const glm::vec3 Normal = glm::normalize(glm::vec3(0.2F, 0.9F, 0.3F));
  const auto Color = [](const glm::vec3 &D) {
    return glm::vec3(0.5F + 0.2F * D.x, 0.5F - 0.1F * D.y, 0.6F);
  };
  const ShColor Fit = fitColor(Normal, Color);
  const glm::vec3 View = -Normal;
  const glm::vec3 Got =
      glm::vec3(0.5F) + 0.28209479F * Fit[0] - 0.48860251F * View.y * Fit[1] +
      0.48860251F * View.z * Fit[2] - 0.48860251F * View.x * Fit[3];
  EXPECT_LT(glm::distance(Got, Color(View)), 0.03F);
}

} // namespace
} // namespace vorion::splat::demo
