// The device's steps against the reference's, gradients at both ends of fp32
// among them.
#include "train/optimize/Adam.h"

#include "device/OnDevice.h"
#include "picture/Layout.h"
#include "reference/Adam.h"
#include "render/Planes.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace vorion::splat {
namespace {

class AdamOnDevice : public OnDevice {
protected:
  static constexpr uint32_t Count = 70;
  static constexpr int Degree = 1;

  static std::vector<float> noise(std::size_t Size, unsigned Seed) {
    std::mt19937 Random(Seed);
    std::normal_distribution<float> Normal;
    std::vector<float> V(Size);
    std::ranges::generate(V, [&] { return Normal(Random); });
    return V;
  }
};

TEST_F(AdamOnDevice, StepsAreTheReferences) {
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  L.build(adamProgram());
  const std::size_t GeometrySize = std::size_t{GEOMETRY_PLANES} * Count;
  const std::size_t ShSize = 3 * shCoefficients(Degree) * Count;
  std::vector<float> Geometry = noise(GeometrySize, 1), Sh = noise(ShSize, 2);
  DeviceScene S = DeviceScene::upload(L, sceneOfPlanes(Geometry, Sh, Degree));

  TrainSettings Settings;
  const double Extent = 4.5;
  std::vector<reference::AdamMoments> GeometryMoments(GeometrySize),
      ShMoments(ShSize);
  std::vector<double> WantGeometry(Geometry.begin(), Geometry.end());
  std::vector<double> WantSh(Sh.begin(), Sh.end());
  for (unsigned Step = 1; Step <= 4; ++Step) {
    std::vector<float> G = noise(GeometrySize, 10 + Step);
    std::vector<float> C = noise(ShSize, 20 + Step);
    for (std::size_t I = 0; I < GeometrySize; ++I)
      G[I] *= std::pow(10.0F, static_cast<float>(I % 7) - 5);
    const PlanePair Gradients{upload(L, G), upload(L, C)};
    stepAdam(L, Settings, S, Gradients, Step, Extent, 0);
    for (std::size_t I = 0; I < GeometrySize; ++I) {
      const std::size_t Plane = I / Count;
      const double Rate = Plane < PLANE_LOG_SCALE
                              ? positionRate(Settings, Step) * Extent
                          : Plane < PLANE_QUATERNION ? 5e-3
                          : Plane < PLANE_LOGIT      ? 1e-3
                                                     : 0.05;
      WantGeometry[I] +=
          reference::adamStep(G[I], Step, Rate, GeometryMoments[I]);
    }
    // The bands that are not in use stay as they are.
    for (std::size_t I = 0; I < 3 * std::size_t{Count}; ++I)
      WantSh[I] += reference::adamStep(C[I], Step, 2.5e-3, ShMoments[I]);
  }
  const auto GotGeometry =
      download<float>(L, S.Parameters.Geometry, GeometrySize);
  const auto GotSh = download<float>(L, S.Parameters.Sh, ShSize);
  for (std::size_t I = 0; I < GeometrySize; ++I)
    EXPECT_NEAR(GotGeometry[I], WantGeometry[I], 1e-6) << I;
  for (std::size_t I = 0; I < ShSize; ++I)
    if (I < 3 * std::size_t{Count}) {
      EXPECT_NEAR(GotSh[I], WantSh[I], 1e-6) << I;
    } else {
      EXPECT_EQ(GotSh[I], Sh[I]) << I;
    }
}

/// The first step is where the corrections are largest; squares of small
/// gradients are subnormal or 0 in fp32, and epsilon then decides.
TEST_F(AdamOnDevice, GradientsAtTheEndsOfTheRangeStepAsTheReference) {
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  L.build(adamProgram());
  const float Cases[] = {0.0F,   1e-45F, 1e-38F,  1e-30F, 1e-23F,
                         1e-22F, 1e-20F, 1e-19F,  1e-17F, 1e-15F,
                         1e-10F, 1.0F,   -1e-20F, 1e10F,  1e18F};
  for (const unsigned Step : {1U, 2U}) {
    const std::vector<float> Zeros(std::size_t{GEOMETRY_PLANES} * Count);
    const std::vector<float> NoColour(3 * std::size_t{Count});
    DeviceScene S = DeviceScene::upload(L, sceneOfPlanes(Zeros, NoColour, 0));
    std::vector<float> G(Zeros.size());
    for (std::size_t I = 0; I < G.size(); ++I)
      G[I] = Cases[I % std::size(Cases)];
    const PlanePair Gradients{upload(L, G), upload(L, NoColour)};
    TrainSettings Settings;
    stepAdam(L, Settings, S, Gradients, Step, 1, 0);
    const auto Got = download<float>(L, S.Parameters.Geometry, G.size());
    for (std::size_t I = 0; I < Count; ++I) {
      const std::size_t At = std::size_t{PLANE_LOGIT} * Count + I;
      reference::AdamMoments M;
      const double Want = reference::adamStep(G[At], Step, 0.05, M);
      if (G[At] == 0)
        EXPECT_EQ(Got[At], 0);
      else // 1e-4: what epsilon leaves of a square that fp32 loses
        EXPECT_NEAR(Got[At], Want, 2e-4 * std::abs(Want) + 1e-30) << G[At];
    }
  }
}

/// Central differences of the weighted means in double.
TEST_F(AdamOnDevice, WeightsHaveTheGradientsOfTheirMeans) {
  constexpr std::size_t Count = 70;
  std::mt19937 Random(8);
  std::normal_distribution<float> Normal;
  Scene Of = Scene::sized(Count, 0);
  for (std::vector<float> *V : {&Of.LogScales, &Of.OpacityLogits})
    std::ranges::generate(*V, [&] { return Normal(Random); });
  TrainSettings T;
  EXPECT_FALSE(isRegularized(T));
  T.OpacityWeight = 0.3;
  T.ScaleWeight = 0.7;
  EXPECT_TRUE(isRegularized(T));
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  L.build(regularizeProgram());
  const DeviceScene S = DeviceScene::upload(L, Of);
  const std::size_t Size = GEOMETRY_PLANES * Count;
  const PlanePair Gradients{upload(L, std::vector<float>(Size, 0.5F)), {}};
  regularize(L, T, S, Gradients);
  const auto Got = download<float>(L, Gradients.Geometry, Size);
  const auto Planes = geometryPlanes(Of);
  const auto Loss = [&](std::size_t Changed, double By) {
    double Opacity = 0, Scale = 0;
    for (std::size_t I = 0; I < Size; ++I) {
      const double V = Planes[I] + (I == Changed ? By : 0);
      const std::size_t Plane = I / Count;
      if (Plane == PLANE_LOGIT)
        Opacity += 1 / (1 + std::exp(-V));
      if (Plane >= PLANE_LOG_SCALE && Plane < PLANE_LOG_SCALE + 3)
        Scale += std::exp(V);
    }
    return T.OpacityWeight * Opacity / Count +
           T.ScaleWeight * Scale / (3 * Count);
  };
  for (std::size_t I = 0; I < Size; ++I)
    EXPECT_NEAR(Got[I], 0.5 + (Loss(I, 1e-4) - Loss(I, -1e-4)) / 2e-4, 1e-7)
        << I;
}

} // namespace
} // namespace vorion::splat
