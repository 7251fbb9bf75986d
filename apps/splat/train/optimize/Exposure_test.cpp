#include "train/optimize/Exposure.h"

#include "device/OnDevice.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace vorion::splat {
namespace {

class ExposureOnDevice : public OnDevice {};

/// Central differences of a loss that is linear in the exposed picture.
TEST_F(ExposureOnDevice, GradientsAreThoseOfTheAffineMap) {
  constexpr uint32_t Pixels = 5000; // two groups
  std::mt19937 Random(4);
  std::uniform_real_distribution<float> Unit(0, 1);
  std::vector<float> Picture(4 * Pixels), Upstream(3 * Pixels);
  std::ranges::generate(Picture, [&] { return Unit(Random); });
  std::ranges::generate(Upstream, [&] { return Unit(Random) - 0.4F; });
  TrainSettings T;
  T.ExposureRate = 0.01;
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Loss);
  L.build(exposureProgram());
  Exposures E(L, T, 3);
  std::vector<float> State(3 * 36, 0);
  std::ranges::generate(State, [&] { return Unit(Random); });
  E.restore(State);
  EXPECT_EQ(E.save(), State);
  const ExposureMatrix M = E.matrix(1);
  EXPECT_EQ(M[0], State[12]);
  const cl::Buffer In = upload(L, Picture), Slopes = upload(L, Upstream);
  const auto Exposed = download<float>(L, E.apply(In, Pixels, 1), 4 * Pixels);
  const ExposureMatrix ByMatrix = E.back(In, Slopes, Pixels, 1);
  const auto ByPicture = download<float>(L, Slopes, 3 * Pixels);
  ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();

  const auto Loss = [&](const ExposureMatrix &Of, std::size_t Changed,
                        double By) {
    double Sum = 0;
    for (std::size_t I = 0; I < Pixels; ++I)
      for (std::size_t C = 0; C < 3; ++C) {
        double Value = Of[4 * C + 3];
        for (std::size_t K = 0; K < 3; ++K)
          Value += Of[4 * C + K] *
                   (Picture[4 * I + K] + (4 * I + K == Changed ? By : 0));
        Sum += Upstream[3 * I + C] * Value;
      }
    return Sum;
  };
  for (std::size_t K = 0; K < M.size(); ++K) {
    ExposureMatrix Up = M, Down = M;
    Up[K] += 0.5;
    Down[K] -= 0.5;
    const double Want = Loss(Up, ~0UL, 0) - Loss(Down, ~0UL, 0);
    EXPECT_NEAR(ByMatrix[K], Want, 1e-5 * Pixels) << K;
  }
  for (const std::size_t I : {0U, 17U, 4095U, 4096U, 4999U}) {
    EXPECT_EQ(Exposed[4 * I + 3], Picture[4 * I + 3]);
    for (std::size_t K = 0; K < 3; ++K)
      EXPECT_NEAR(ByPicture[3 * I + K],
                  Loss(M, 4 * I + K, 0.5) - Loss(M, 4 * I + K, -0.5), 1e-6);
  }
}

TEST_F(ExposureOnDevice, TheMeanStaysTheIdentity) {
  TrainSettings T;
  Launcher L(*Dev, "", {});
  EXPECT_TRUE(Exposures(L, T, 3).save().empty());
  T.ExposureRate = 0.01;
  Exposures E(L, T, 3);
  ExposureMatrix Up{};
  Up[0] = 1;
  E.step({{1, Up}}, 1);
  // Adam's first step is the rate, of which the mean takes a third away.
  EXPECT_NEAR(E.matrix(1)[0], 1 - 0.01 * 2 / 3, 1e-6);
  EXPECT_NEAR(E.matrix(0)[0], 1 + 0.01 / 3, 1e-6);
  for (unsigned I = 2; I < 30; ++I)
    E.step({{I % 3, Up}, {0, Up}}, I);
  for (std::size_t K = 0; K < 12; ++K)
    EXPECT_NEAR(E.matrix(0)[K] + E.matrix(1)[K] + E.matrix(2)[K],
                K % 5 == 0 ? 3 : 0, 1e-6);
  // For other pictures they begin anew.
  E.restore(std::vector<float>(36, 7));
  EXPECT_EQ(E.matrix(2)[5], 1);
  EXPECT_EQ(E.matrix(2)[4], 0);
}

} // namespace
} // namespace vorion::splat
