#include "explore/Judge.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <string>

using namespace vorion::splat;

namespace {

/// Of a machine that draws.
Figures frames(Speed Is, double Area) { return {{Is, std::nullopt}, Area}; }

const std::vector<Figures> Five{frames({10, 2}, 3), frames({20, 2}, 3),
                                frames({20, 3}, 3), frames({5, 1}, 9),
                                frames({20, 2}, 3)};

TEST(Judge, OfEqualMachinesTheFirstIsOnTheFront) {
  EXPECT_EQ(paretoFront(Five), (std::vector<std::size_t>{1, 3}));
}

TEST(Judge, EqualMachinesStayWhereTheyMayDifferElsewhere) {
  EXPECT_EQ(paretoFront(Five, /*KeepsEqual=*/true),
            (std::vector<std::size_t>{1, 4, 3}));
}

TEST(Judge, FrontsFollowUntilThereAreEnough) {
  EXPECT_EQ(bestFronts(Five, 1), (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(bestFronts(Five, 3), (std::vector<std::size_t>{1, 3, 4}));
  EXPECT_EQ(bestFronts(Five, 9).size(), 5U);
}

/// Drawing and training are judged apart: what is better at one of them alone
/// is on the front.
TEST(Judge, EachKindOfWorkCounts) {
  const std::vector<Figures> Four{{{Speed{20, 2}, Speed{1, 2}}, 3},
                                  {{Speed{10, 2}, Speed{5, 2}}, 3},
                                  {{Speed{10, 2}, Speed{4, 2}}, 3},
                                  {{Speed{10, 2}, Speed{4, 1}}, 3}};
  EXPECT_EQ(paretoFront(Four), (std::vector<std::size_t>{0, 1, 3}));
}

/// Without frames, the fastest by iterations come first.
TEST(Judge, MachinesThatOnlyTrainHaveAFront) {
  const std::vector<Figures> Three{{{std::nullopt, Speed{4, 1}}, 3},
                                   {{std::nullopt, Speed{5, 2}}, 3},
                                   {{std::nullopt, Speed{4, 1}}, 4}};
  EXPECT_EQ(paretoFront(Three), (std::vector<std::size_t>{1, 0}));
}

TEST(Judge, RanksAreComparedNotValues) {
  const std::array A{1.0, 2.0, 3.0, 4.0};
  EXPECT_DOUBLE_EQ(rankCorrelation(A, std::array{1.0, 10.0, 11.0, 1e9}), 1);
  EXPECT_DOUBLE_EQ(rankCorrelation(A, std::array{4.0, 3.0, 2.0, 1.0}), -1);
  EXPECT_DOUBLE_EQ(rankCorrelation(A, std::array{7.0, 7.0, 7.0, 7.0}), 0);
  // Ranks 0, 1.5, 1.5, 3 against 0 to 3: 4.5 / sqrt(4.5 * 5).
  EXPECT_DOUBLE_EQ(rankCorrelation(A, std::array{1.0, 2.0, 2.0, 3.0}),
                   4.5 / std::sqrt(22.5));
}

/// All machines of three parameters of two values, eight times over.
struct Factorial {
  Space S{
      {"a", {{"1", "", {}}}}, {"b", {{"1", "", {}}}}, {"c", {{"1", "", {}}}}};
  std::vector<Choices> Machines;
  Factorial() {
    for (std::size_t N = 0; N < 64; ++N)
      Machines.push_back({N & 1, N >> 1 & 1, N >> 2 & 1});
  }
};

TEST(Judge, ProductsOfEffectsAreNoInteraction) {
  const Factorial F;
  std::vector<double> Rates;
  Rates.reserve(F.Machines.size());
  for (const Choices &C : F.Machines)
    Rates.push_back(100 * (C[0] ? 2 : 1) * (C[1] ? 0.5 : 1) * (C[2] ? 3 : 1));
  EXPECT_TRUE(interactions(F.S, F.Machines, Rates).empty());
}

/// Noise of 5 %, which three standard errors would let through.
TEST(Judge, NoiseIsNoInteraction) {
  Space S;
  for (std::size_t P = 0; P < 10; ++P)
    S.push_back({std::to_string(P), {{"1", "", {}}, {"2", "", {}}}});
  for (uint64_t Seed = 1; Seed <= 5; ++Seed) {
    std::size_t Singles = 0;
    const std::vector<Choices> Machines = machinesOf(S, 300, Seed, Singles);
    std::mt19937_64 Random(Seed);
    std::vector<double> Rates(Machines.size());
    for (double &Rate : Rates)
      Rate = 95 + static_cast<double>(Random() % 1000) / 100;
    EXPECT_TRUE(interactions(S, Machines, Rates).empty()) << Seed;
  }
}

TEST(Judge, WhatHelpsOnlyTogetherIsFound) {
  const Factorial F;
  std::vector<double> Rates;
  for (std::size_t N = 0; N < F.Machines.size(); ++N) {
    const Choices &C = F.Machines[N];
    const double Noise = 1 + 0.01 * std::sin(static_cast<double>(7 * N));
    Rates.push_back(100 * (C[0] && C[2] ? 2 : 1) * (C[1] ? 3 : 1) * Noise);
  }
  const auto Found = interactions(F.S, F.Machines, Rates);
  ASSERT_FALSE(Found.empty());
  EXPECT_EQ(Found.front().First, 0U);
  EXPECT_EQ(Found.front().Second, 2U);
  EXPECT_NEAR(Found.front().Factor, 2, 0.05);
}

} // namespace
