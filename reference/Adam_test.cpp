#include "Adam.h"
#include "Density.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace vorion::reference;

namespace {

/// Corrected for its bias, the first step is as long as the rate.
TEST(Adam, FirstStepIsTheRate) {
  for (const double Gradient : {3.0, -1e-3, 1e-9}) {
    AdamMoments M;
    EXPECT_NEAR(adamStep(Gradient, 1, 0.01, M), Gradient > 0 ? -0.01 : 0.01,
                1e-8);
  }
}

/// A constant gradient stays at steps of the rate.
TEST(Adam, SteadyGradientsKeepTheRate) {
  AdamMoments M;
  for (unsigned Step = 1; Step < 500; ++Step)
    EXPECT_NEAR(adamStep(0.3, Step, 0.01, M), -0.01, 1e-12);
}

TEST(Adam, NoGradientMovesNothing) {
  AdamMoments M;
  EXPECT_EQ(adamStep(0, 1, 0.01, M), 0);
  EXPECT_EQ(M.First, 0);
}

/// A gradient below epsilon is damped by it.
TEST(Adam, TinyGradientsAreDamped) {
  AdamMoments M;
  EXPECT_NEAR(adamStep(1e-15, 1, 1, M), -0.5, 1e-12);
}

TEST(Density, EachFateHasItsReason) {
  const double Never = std::numeric_limits<double>::infinity();
  DensityRule R;
  R.SplitScale = 0.1;
  R.MostScale = R.MostRadius = Never;
  R.MostGaussians = 100;
  const std::vector<DensityFacts> G{{0, 0.05, 0.5, 5},      // nothing happens
                                    {3e-4, 0.05, 0.5, 5},   // clone
                                    {3e-4, 0.11, 0.5, 5},   // split
                                    {3e-4, 0.11, 0.004, 5}, // too thin
                                    {0, 5, 0.5, 500}};      // large
  using enum Fate;
  EXPECT_EQ(fatesOf(G, R), (std::vector{Keep, Clone, Split, Drop, Keep}));
  R.MostScale = 0.1;
  EXPECT_EQ(fatesOf(G, R), (std::vector{Keep, Clone, Split, Drop, Drop}));
  R.MostRadius = 4; // the halves of a split have none yet
  EXPECT_EQ(fatesOf(G, R), (std::vector{Drop, Drop, Split, Drop, Drop}));
}

TEST(Density, LargestGradientsGrowWhereThereIsLittleRoom) {
  DensityRule R;
  R.SplitScale = R.MostScale = R.MostRadius =
      std::numeric_limits<double>::infinity();
  R.MostGaussians = 6;
  const std::vector<DensityFacts> G{
      {3e-4, 1, 1, 1}, {5e-4, 1, 1, 1}, {3e-4, 1, 1, 1}, {0, 1, 1, 1}};
  using enum Fate;
  EXPECT_EQ(fatesOf(G, R), (std::vector{Clone, Clone, Keep, Keep}));
  R.MostGaussians = 3;
  EXPECT_EQ(fatesOf(G, R), (std::vector{Keep, Keep, Keep, Keep}));
}

} // namespace
